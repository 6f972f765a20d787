#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "experiments/config/experiment_config.h"
#include "planner/scene/scene.h"
#include "wpg/motion/half_step_sequence.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// A straight flight of level treads, which a robot walks up or down along x of W from where it
/// stands at the origin, foot over foot. Up, the first riser is half a tread ahead.
struct Flight {
  double rise = 0.0;  ///< of each riser [m]
  double run = 0.0;   ///< depth of each tread [m]
  int treads = 3;     ///< how many
};

constexpr double kFlightWidth = 2.0;  ///< of every flight [m]

/// The scene of a flight: up from the floor, or down to it from the highest tread.
Scene SceneOf(const Flight& flight, bool up);
/// The footsteps along it, one on each tread, the last beside the one before, by half-steps of the
/// form of `half_step`.
HalfStepSequence WalkAlong(const Flight& flight, bool up, const RobotModel& robot,
                           const HalfStep& half_step);

/// The depth of a tread that a robot's sole has room on: 1.3 of its length [m].
double UsualRun(const RobotModel& robot);
/// The least rise that is tried for a robot, of which the others are multiples [m].
double LeastRise(const RobotModel& robot);

/// A flight and the form of the half-steps by which a robot walks up and down it.
struct ClimbedStairs {
  Flight flight;             ///< the stairs
  HalfStepConfig half_step;  ///< duration, via point, shape and crouch
};

/// Whether a search shall go on.
using GoesOn = std::function<bool()>;

/// The form by which a robot walks along a flight one isolated half-step after the other, up and
/// down, certified for all t under the config's margins: the first of HalfStepTable that does. None
/// when none does.
std::optional<HalfStepConfig> FormFor(const Flight& flight, const RobotModel& robot,
                                      const ExperimentConfig& config, const GoesOn& goes_on);

/// The highest flight with treads of `run` [m], found by halves: what is told is certified, whether
/// or not all lower ones are. None when no rise of those that were tried is.
std::optional<ClimbedStairs> HighestStairs(double run, const RobotModel& robot,
                                           const ExperimentConfig& config, const GoesOn& goes_on);

}  // namespace halfstep
