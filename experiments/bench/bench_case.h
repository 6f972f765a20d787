#pragma once

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "experiments/bench/bench_scene.h"
#include "experiments/config/toolbox.h"
#include "wpg/files/yaml_fields.h"

namespace halfstep {

/// Which scenes of the benchmark, for which robot, and who answers them.
struct BenchSelection {
  std::vector<std::string> kinds;     ///< of BenchKinds()
  std::vector<int> difficulties;      ///< each 1 to kMostDifficult
  int seeds = 3;                      ///< 1 to this, at most kMostBenchSeed
  std::string robot = "hrp2";         ///< a shipped robot's name or a robot file
  std::vector<std::string> planners;  ///< names of planners; empty with `footsteps`
  /// Folder of footsteps from elsewhere, in place of planners: NAME.csv or NAME.yaml for a scene.
  std::string footsteps;
  std::vector<YamlOverride> overrides;  ///< of every scene's config
  Toolbox tools = {};                   ///< that configs may name
};

/// The scenes of a selection: kinds slowest, seeds quickest.
std::vector<BenchKey> KeysOf(const BenchSelection& selection);

/// One scene and who answers it.
struct BenchCase {
  BenchKey key;         ///< the scene
  std::string planner;  ///< a planner's name; "footsteps": they come from elsewhere

  /// "below_3_012-astar_classic": of its files.
  std::string Id() const;
};
/// Scenes times planners, planners quickest.
std::vector<BenchCase> CasesOf(const BenchSelection& selection);

/// Reads a config as every planner of a selection gets it, so that mistakes of `overrides` are told
/// before anything is written. Throws InputError, also for keys that the benchmark sets.
void CheckOverrides(const BenchSelection& selection, const BenchSizes& sizes);

/// What became of a case.
struct BenchRow {
  /// solved; what PlanStatus has; of footsteps from elsewhere missing, other_start,
  /// not_certified, does_not_arrive; error.
  std::string status;
  int footsteps = 0;               ///< 0 unless it is solved
  std::optional<double> raw;       ///< of the half-steps one after the other [s]
  std::optional<double> smoothed;  ///< of the walk by the config's last method [s]
  bool certified = false;          ///< that walk, for all t
  double nodes = 0.0;              ///< of the planner
  double effort = 0.0;             ///< counted work of the planner
  double crouch = 0.0;             ///< the largest of its half-steps [m]
  std::string message;             ///< in words
  double wall = 0.0;               ///< of planning, by this machine's clock [s]
  std::string footsteps_yaml;      ///< as --footsteps takes them; "": none
};

/// Does a case with the config NAME.yaml of the folder `scenes`. None when stopped. Throws
/// InputError for what cannot be read.
std::optional<BenchRow> DoBenchCase(const BenchSelection& selection, const BenchCase& one,
                                    const std::filesystem::path& scenes,
                                    const std::stop_token& stop);

}  // namespace halfstep
