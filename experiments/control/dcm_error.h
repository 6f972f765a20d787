#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>

#include "experiments/control/ankle_bush.h"
#include "experiments/control/state_estimate.h"
#include "experiments/control/tracking_controller.h"

namespace halfstep::control {

/// How far the divergent component of motion ξ = c + ċ/ω, ω = √(g/z_c), of a robot is from its
/// plan, as encoders, IMU and soles have it (EstimateState): low-pass. What is known of bushes
/// above the feet counts. Source: [Englsberger2015] §III.
class DcmError {
 public:
  /// Borrows `robot`, whose masses are known. `ankle`: the bushes; none: rigid ankles. `filter`:
  /// time constant [s].
  DcmError(const RobotModel& robot, const std::optional<JointSpring>& ankle, double filter);

  /// Takes a measurement in, `period` [s] after the one before; `then` was planned for measured.t.
  /// Returns where the robot believes to be.
  EstimatedState Sense(const MeasuredState& measured, const PlannedState& then, double period);

  const Eigen::Vector2d& value() const { return value_; }  ///< measured less planned, in W [m]

 private:
  void Yield(const MeasuredState& measured, const PlannedState& then, double period);

  const RobotModel& robot_;
  double omega_, filter_;
  std::array<AnkleBush, 2> bushes_;
  Eigen::Vector2d value_{0, 0};
};

}  // namespace halfstep::control
