#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "opt/solvers/ending.h"
#include "wpg/robot/not_covered.h"

namespace halfstep {

/// The incumbent of a method after one of its candidates, as iterates.csv has it.
struct IncumbentRecord {
  double wall = 0.0;      ///< since the method began [s]
  double instants = 0.0;  ///< instants evaluated so far
  double effort = 0.0;    ///< used so far (Work::effort)
  double duration = 0.0;  ///< of the incumbent [s]
};

/// The result of one method in a scenario, as a run folder records it.
struct MethodRecord {
  std::string run;                            ///< the run folder, as it was named
  std::string name;                           ///< "ipopt", or "LABEL:ipopt"
  std::string variables;                      ///< "overlaps+heights+durations"; "" for raw
  std::string objective = "fastest";          ///< that the method pursued
  std::string requested;                      ///< its options, as JSON text
  opt::Ending ending = opt::Ending::kNotRun;  ///< how the method ended
  std::string message;                        ///< a sentence on the ending
  bool certified = false;                     ///< whether its walk is proved for all t
  double duration = 0.0;                      ///< [s]
  double speedup = 0.0;  ///< duration of the planned walk over that of this one
  double cost = 0.0;     ///< by the objective, as in SmoothingResult::cost
  /// (cost − reference)/|reference|; none without a reference.
  std::optional<double> gap_to_reference;
  std::optional<double>
      gap_lipm;  ///< above the lower bound; none where summary.csv does not say it
  /// Work: instants at which margins were evaluated; queries of distances; Work::effort.
  double instants = 0.0, collision_queries = 0.0, effort = 0.0;
  double wall = 0.0;                        ///< [s]
  std::vector<IncumbentRecord> incumbents;  ///< in the order of time

  bool raw() const { return name == "raw"; }  ///< whether this is the planned walk itself
  /// Whether it has a proved walk of its own; no other is the best of a scenario or has solved it.
  bool solved() const { return certified && HasOwnResult(ending); }
};

/// A run folder in memory.
struct RunRecord {
  std::string run;        ///< as it was named
  std::string scenario;   ///< the manifest's `name`
  std::string objective;  ///< "fastest" …
  /// SHA-256 of all that defines the problem: footsteps, robot, scene, limits, demanded margins.
  std::string problem;
  std::string manifest_sha256;          ///< of the folder's manifest, as hexadecimal text
  int half_steps = 0;                   ///< of the walk
  std::vector<NotCovered> not_covered;  ///< what its certificates do not speak of
  std::vector<MethodRecord> methods;    ///< raw first
};

/// Whether the manifest.json of a folder says that it is an episode's; false without one. Throws
/// InputError for a manifest that cannot be read.
bool IsEpisode(const std::filesystem::path& folder);

/// The same for a sweep's folder.
bool IsSweep(const std::filesystem::path& folder);

/// Reads a run folder that `halfstep run` wrote: manifest.json, summary.csv, footsteps.csv,
/// raw/certificate.json and each method's iterates.csv. `argument` is RUN or LABEL=RUN; the label
/// (letters, digits, "_", ".", "-", "-" not first) goes before the names of its methods but raw.
/// Throws InputError for whatever is missing, damaged or contradicts itself.
RunRecord ReadRun(const std::string& argument);

}  // namespace halfstep
