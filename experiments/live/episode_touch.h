#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/live/episode.h"
#include "experiments/live/promise.h"
#include "experiments/live/true_world.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// The nearest that the walking robot truly came to an obstacle.
struct Approach {
  double distance = 0.0;  ///< [m], at most the cap that was asked for; ≤ 0: it touched
  double t = 0.0;         ///< [s]
  std::string obstacle;   ///< "": none within the cap
  std::string body;       ///< of the robot; "" where there is no obstacle
};

/// Looks at the executed motion every `period` [s] while it moves, at the obstacles where they
/// truly are then. Sampled: what happens between the instants is not seen. Instants at which the
/// robot is at rest do not count: an obstacle that is carried against a standing robot is not its
/// doing. Obstacles nearer than `cap` [m] are told.
Approach NearestApproach(const Episode& episode, const TrueWorld& truth, const RobotModel& robot,
                         double period, double cap, bool also_at_rest = false);

/// The obstacles that the robot touches while it moves: each with the first instant, every kLook,
/// that lies within a half-step at which it touches the obstacle where it truly is. In the order of
/// these instants.
std::vector<TouchedObstacle> FindTouches(const Episode& episode, const TrueWorld& truth,
                                         const RobotModel& robot);

}  // namespace halfstep
