#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "experiments/bench/bench_case.h"
#include "experiments/config/experiment_config.h"

namespace halfstep {

/// Footsteps from elsewhere for a scene of the benchmark.
struct GivenFootsteps {
  std::optional<ExperimentConfig> config;  ///< that walks them; none: nothing is to be checked
  /// missing, or other_start: they begin elsewhere. "": there is something to check.
  std::string status;
  std::string message = {};  ///< the same in words
};

/// Text of the config of a scene in a folder that has it. Throws InputError.
std::string ReadBenchConfig(const std::filesystem::path& scenes, const BenchKey& key);

/// Reads NAME.csv (experiments/config/footsteps_file.h) or NAME.yaml (what `halfstep plan` prints)
/// of selection.footsteps. `scene` is what the config's scene is called by, an absolute path or
/// `none`; `config` is the text of the scene's config, of which robot, start and methods stay.
/// Throws InputError.
GivenFootsteps ReadGivenFootsteps(const BenchSelection& selection, const BenchKey& key,
                                  const std::string& scene, const std::string& config);

/// Reads all footsteps of a selection once, so that mistakes are told before anything is written.
/// Throws InputError, also for a folder without any of these scenes, or with a file of no scene.
void CheckFootsteps(const BenchSelection& selection, const BenchSizes& sizes);

}  // namespace halfstep
