#pragma once

#include <Eigen/Core>
#include <array>

#include "wpg/motion/posture.h"

namespace halfstep {

/// The gradient of one number with respect to what a posture is made of, and to the walk's
/// quantities: the counterpart of PostureTangent, per unit of each. Zero until something is added.
struct PostureGradient {
  WalkJet jet;                     ///< of the quantities themselves: `value` …, in W
  Eigen::Vector3d waist{0, 0, 0};  ///< of B's origin, in W [1/m]
  double waist_yaw = 0.0;          ///< with it held [1/rad]
  std::array<Eigen::Vector3d, 2> sole_B = {Eigen::Vector3d::Zero(),
                                           Eigen::Vector3d::Zero()};  ///< of the sole, from B [1/m]
  std::array<Vector6d, 2> q = {Vector6d::Zero(), Vector6d::Zero()};   ///< of angles [1/rad]
  std::array<Vector6d, 2> speeds = {Vector6d::Zero(), Vector6d::Zero()};  ///< of speeds [s/rad]

  /// Adds that of weight_W · (the place in W of a point that is fixed in `body` and now at p_W
  /// [m]).
  void AddPoint(const RobotBody& body, const Posture& posture, const Eigen::Vector3d& p_W,
                const Eigen::Vector3d& weight_W);
};

/// The same number's gradient with respect to the walk's quantities alone, through waist, legs and
/// joints: the transpose of Differentiate (posture_tangent.h), so that for every tangent the
/// gradient's product with Differentiate(tangent) is the result's product with the tangent. One
/// gradient costs about as much as one tangent. Precondition: the posture's joint speeds are
/// solved.
WalkJet PulledBack(const RobotModel& robot, const WalkJet& jet, const Posture& posture,
                   const PostureGradient& gradient);

}  // namespace halfstep
