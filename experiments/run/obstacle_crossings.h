#pragma once

#include <vector>

#include "experiments/config/experiment.h"
#include "experiments/run/crossing.h"
#include "planner/scene/scene.h"

namespace halfstep {

/// Stances astride an obstacle that rests on a flat floor, at the middle of its narrower side
/// (FootprintOf), drawn from the config's seed: a sole and one that lands at one of `places`, seen
/// from a left support, turned any way, of which one stands before the obstacle and one behind,
/// both off it as `clearance` demands, to which the landing foot comes from before the obstacle,
/// and from which the other goes on. 96 of them, fewer where 20,000 tries find no more; none: the
/// obstacle is too deep for the set.
std::vector<Crossing> DrawObstacleCrossings(const ExperimentConfig& config, const RobotModel& robot,
                                            const Obstacle& obstacle, std::vector<Foothold> places);

}  // namespace halfstep
