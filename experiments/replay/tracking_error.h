#pragma once

#include <vector>

#include "experiments/replay/reference_motion.h"
#include "experiments/replay/simulation.h"

namespace halfstep::replay {

/// How far a simulated robot is from its plan at an instant, the plan shifted on the floor with the
/// sole that carries: the larger of both soles, the largest of all joints.
struct TrackingError {
  double foot = 0.0;      ///< of a sole's centre [m]
  double foot_yaw = 0.0;  ///< of a sole [rad]
  double waist = 0.0;     ///< of the waist's origin [m]
  double joint = 0.0;     ///< of a joint of the legs [rad]
};

/// The error at t [s] of the plan that is shifted by `shift` [m], in W.
TrackingError TrackingErrorOf(const Simulation& robot, const ReferenceMotion& motion, double t,
                              const Eigen::Vector3d& shift);

/// The errors of many instants, each number by itself.
struct TrackingErrors {
  TrackingErrors() = default;  ///< of no instant
  /// Without instants all are 0.
  explicit TrackingErrors(const std::vector<TrackingError>& errors);

  TrackingError most;     ///< what 95 % of the instants do not exceed
  TrackingError largest;  ///< of all
};

}  // namespace halfstep::replay
