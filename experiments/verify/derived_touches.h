#pragma once

#include <vector>

#include "experiments/verify/described_walk.h"
#include "experiments/verify/episode_text.h"
#include "experiments/verify/episode_truth.h"
#include "experiments/verify/promise_text.h"
#include "planner/scene/scene.h"

namespace halfstep::verify {

/// What is true or was measured is looked at so often [s].
inline constexpr double kLook = 0.005;

/// The obstacles that the robot touches where they truly are, each with the first instant, every
/// kLook, that lies within a half-step and before `episode_end` [s]. By name. `walk` is the
/// executed one, `all` has the boxes to spare.
std::vector<TouchText> TouchesOf(const EpisodeText& episode, const DescribedWalk& walk,
                                 double episode_end, const Scene& all, const EpisodeTruth& truth);

}  // namespace halfstep::verify
