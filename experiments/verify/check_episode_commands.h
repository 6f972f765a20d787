#pragma once

#include "experiments/live/live_config.h"
#include "experiments/verify/episode_text.h"
#include "experiments/verify/findings.h"

namespace halfstep::verify {

/// Whether events.csv tells the commands of the config's script (`walk`, `follow`, `footsteps`) as
/// frames made them known, by its own reading of the script: from the world of the first grant on
/// one row `commanded` for each world with another command than the one before, and no other;
/// whether a robot that was commanded in place of its goal has not arrived; and whether the walks
/// that plans.csv calls `commanded` end with footsteps that had been commanded by then. Where
/// clients measured, and of killed episodes, the script does not say what was commanded: then only
/// that this is not examined. How far a walk keeps to a velocity or a path is not examined.
void CheckEpisodeCommands(const EpisodeText& episode, const EpisodeManifest& manifest,
                          const LiveOptions& options, Findings* findings);

}  // namespace halfstep::verify
