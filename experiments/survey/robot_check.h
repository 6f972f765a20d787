#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/run/experiment_run.h"
#include "experiments/survey/climbed_stairs.h"
#include "wpg/motion/half_step.h"
#include "wpg/robot/not_covered.h"
#include "wpg/robot/robot_measures.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// How far the half-steps of a robot's default set go. Each end is that of one place of the swing
/// sole beside the support sole whose down and up half-steps are both certified on an empty floor.
struct SetReach {
  double forward = 0.0, backward = 0.0;  ///< of the support sole's centre, along its x [m]
  double nearest = 0.0, farthest = 0.0;  ///< aside of it, along its y [m]
  double inwards = 0.0, outwards = 0.0;  ///< turns of the toes [rad], ≥ 0
  /// Of a step straight ahead, the feet as far apart as they stand [m]; 0: there is none.
  double stride = 0.0;
};

/// A walk of six steps straight ahead from rest to rest, the last of which closes up.
struct StraightWalk {
  double stride = 0.0;                                      ///< of each step but the last [m]
  double duration = 0.0;                                    ///< [s]
  std::string method;                                       ///< that smoothed it
  double speed() const { return 5.0 * stride / duration; }  ///< of its CoM, mean [m/s]
};

/// A box across the way that the robot steps over, both feet one after the other.
struct SteppedBar {
  double height = 0.0, thickness = 0.0;  ///< [m]
  double stride = 0.0;                   ///< over it [m]
};

/// What a robot can do by the defaults of a config without numbers, at a small effort.
struct RobotCheck {
  RobotMeasures measures;            ///< of the robot
  HalfStep half_step;                ///< duration and via point of all that follows
  int places = 0;                    ///< of the grid
  int half_steps = 0;                ///< of these, those that keep every margin, sampled
  SetReach reach;                    ///< certified
  std::optional<StraightWalk> walk;  ///< the fastest of the certified ones that were tried
  /// What a joint lacks at rest on one foot (RestText), then what the slowest of them misses;
  /// empty: a walk.
  std::vector<std::string> why_no_walk;
  std::optional<SteppedBar> bar;  ///< the highest; none: of the heights tried none is certified
  std::optional<ClimbedStairs> stairs;  ///< the highest (HighestStairs)
  std::vector<NotCovered> not_covered;  ///< what no certificate about the walk speaks of
};

/// Looks at what a robot can do: of all places of its step set by samples, of those farthest out by
/// proof, six steps of two strides by `dichotomy` and `halfstep/sqp`, a bar that is raised as long
/// as the steps over it are certified, the foot moving on as by default or later (0.19), and
/// stairs.
/// `name`: the robot as a config names it, its file's path or a shipped name. Progress is told from
/// 0 to 1.
RobotCheck CheckRobot(const std::string& name, const RobotModel& robot, const RunHooks& hooks,
                      double effort = 1.0);

}  // namespace halfstep
