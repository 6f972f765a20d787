#pragma once

#include "experiments/live/live_config.h"
#include "experiments/verify/episode_text.h"
#include "experiments/verify/findings.h"

namespace halfstep::verify {

/// Whether the times of manifest.json fit what was recorded: nothing is later than `end_s`, and,
/// where a stand-in senses, nothing was measured before the robot began to wait, and the last frame
/// is no longer before the end than the next one would have come.
void CheckEpisodeTimes(const EpisodeText& episode, const EpisodeManifest& manifest,
                       const LiveOptions& options, Findings* findings);

}  // namespace halfstep::verify
