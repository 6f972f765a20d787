#pragma once

#include <filesystem>

#include "experiments/config/experiment.h"
#include "experiments/live/episode.h"
#include "experiments/live/live_config.h"

namespace halfstep {

/// The record of an episode from its folder, whose config and place are those given. Of worlds
/// there is all but `stays`, of walks all but `smoothed`. Throws InputError for files that are
/// missing, damaged or do not belong together.
Episode ReadEpisode(const std::filesystem::path& folder, const LiveConfig& config,
                    const Place& place);

/// The same from what a killed process left (EpisodeJournal): rows that were cut are left out, and
/// the episode ends, as kKilled, with the latest tick.
Episode ReadJournal(const std::filesystem::path& folder, const LiveConfig& config,
                    const Place& place);

}  // namespace halfstep
