#pragma once

#include <filesystem>
#include <string>

#include "experiments/config/experiment.h"
#include "experiments/live/episode.h"
#include "experiments/live/live_config.h"
#include "experiments/tables/run_folder.h"

namespace halfstep {

/// report.html of an episode: the live page as a recording, below 5 MB, without need of another
/// file or of network. `folder` holds trajectory.csv, unless the episode has no walk. Of long
/// episodes only every k-th world, walk and grant is shown, and the page says so. The same record
/// gives the same bytes in lockstep. Precondition: HasReport().
std::string EpisodeReport(const Episode& episode, const LiveConfig& config, const Place& place,
                          const std::filesystem::path& folder);

/// Writes it into a folder that has trajectory.csv; does nothing without HasReport().
void WriteEpisodeReport(const Episode& episode, const LiveConfig& config, const Place& place,
                        RunFolder* folder);

}  // namespace halfstep
