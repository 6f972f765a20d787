#pragma once

#include <cstdint>

#include "experiments/live/live_config.h"
#include "planner/scene/scene.h"

namespace halfstep {

/// An episode that is drawn at random: its scene, and the goal, the sensing and the script that are
/// put into `config`.
struct RandomEpisode {
  LiveConfig config;
  Scene scene;
};

/// A room of 4 × 3 m from whose west end the robot walks to the east, with 5 to 15 obstacles on,
/// before and beside the way: boxes, bars and cylinders on the floor. One to four times one of them
/// jumps, mostly to where the robot is going, is carried at 0.1 to 0.5 m/s, or the goal moves.
/// Frames come 5, 20 or 100 times a second with 0 to 2 cm of noise, which is what is assumed of it,
/// as is the speed of what is carried. In two of three episodes obstacles that stay for
/// half a second are taken to rest; in the others what is carried may move at any time. The same
/// seed gives the same episode. `config` is the experiment to start from.
RandomEpisode DrawEpisode(const LiveConfig& config, std::uint64_t seed);

}  // namespace halfstep
