#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "experiments/plot/plotted_run.h"

namespace halfstep::plot {

/// A thing that can be drawn of a run: its name on the command line, and its panels.
struct RunSubject {
  const char* name;                                 ///< as in `--what`
  const char* what;                                 ///< for the help
  std::vector<Row> (*rows)(const PlottedRun& run);  ///< at least one
};
/// All of them. To add one, write its file and a row in the source.
std::span<const RunSubject> RunSubjects();

/// The same of a folder that `halfstep compare` or `halfstep sweep` wrote, for the methods that are
/// named; none: all.
struct FolderSubject {
  const char* name;  ///< as in `--what`
  const char* what;  ///< for the help
  /// At least one.
  std::vector<Row> (*rows)(const std::filesystem::path& folder,
                           const std::vector<std::string>& methods);
};
std::span<const FolderSubject> ComparisonSubjects();  ///< of comparisons
std::span<const FolderSubject> SweepSubjects();       ///< of sweeps

// Each throws InputError for tables that are missing or damaged.

/// From above: footprints, obstacles, no-step areas, CoM and ZMP, on equal axes.
std::vector<Row> WalkRows(const PlottedRun& run);
/// Heights and places ahead of both soles against time.
std::vector<Row> FootRows(const PlottedRun& run);
/// From the side: the soles' heights along the way, and the obstacles in it.
std::vector<Row> SideRows(const PlottedRun& run);
/// CoM and ZMP against time, in the band that the standing soles give.
std::vector<Row> ZmpRows(const PlottedRun& run);
/// Proved margins of the families with least slack against time, and what is demanded.
std::vector<Row> MarginsRows(const PlottedRun& run);
/// Joint angles and speeds of the legs against time, and their limits.
std::vector<Row> JointsRows(const PlottedRun& run);

/// Durations of the methods in each scenario.
std::vector<Row> DurationsRows(const std::filesystem::path& comparison,
                               const std::vector<std::string>& methods);
/// The fraction of scenarios that are solved within a multiple of the least work.
std::vector<Row> ProfilesRows(const std::filesystem::path& comparison,
                              const std::vector<std::string>& methods);
/// The best walk so far against work, in each scenario.
std::vector<Row> AnytimeRows(const std::filesystem::path& comparison,
                             const std::vector<std::string>& methods);
/// Durations against the first key that varies; a line for each value of the second.
std::vector<Row> SweepRows(const std::filesystem::path& sweep,
                           const std::vector<std::string>& methods);

/// Places of the swing foot beside the support foot, of a table of `halfstep list half-steps`.
std::vector<Row> HalfStepsRows(const std::filesystem::path& table);

}  // namespace halfstep::plot
