#pragma once

#include <array>
#include <functional>
#include <vector>

#include "experiments/verify/half_step_motion.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::verify {

/// Joint angles of both legs at evenly spaced times of a walk, for legs whose axes miss each other:
/// from these Newton's method reaches the angles at any time between them in a few steps, where the
/// way from the leg whose axes meet takes dozens. Every sixteenth of them goes that way, and the
/// fifteen before it count only if they lead to the same angles; else they go it as well. Empty for
/// other robots.
class LegGuide {
 public:
  LegGuide() = default;
  /// The walk's numbers at a time [s].
  using Numbers = std::function<WalkNumbers(double)>;

  /// Forgets what lies after `from` [s], and finds the angles from there to `to`.
  void Extend(const RobotModel& robot, double from, double to, const Numbers& numbers);

  /// About the angles at a time [rad]; nan for a leg of which nothing is known there.
  std::array<Vector6d, 2> Near(double t) const;

 private:
  double period_ = 0.0;                          // [s]
  std::vector<std::array<Vector6d, 2>> angles_;  // at multiples of it; nan: not reached
};

}  // namespace halfstep::verify
