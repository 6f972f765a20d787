#pragma once

#include <filesystem>
#include <string>

#include "experiments/config/experiment.h"
#include "experiments/live/episode.h"
#include "experiments/live/live_config.h"
#include "experiments/tables/run_folder.h"

namespace halfstep {

/// The text of config.yaml in `folder`: the config as resolved, its paths relative to there.
std::string ResolvedFor(const std::filesystem::path& folder, const LiveConfig& config);

/// Writes every file of the folder. Only timings.csv, and what the manifest says of the machine and
/// the time, are not the same whenever the episode is run in lockstep.
void WriteEpisode(const Episode& episode, const LiveConfig& config, const Place& place,
                  RunFolder* folder);

}  // namespace halfstep
