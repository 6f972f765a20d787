#pragma once

#include <Eigen/Core>
#include <array>

#include "wpg/motion/posture.h"

namespace halfstep {

/// How a posture and its joint speeds change when the walk's quantities change by a tangent: the
/// derivative along one homotopy parameter, or in time. Per unit of that parameter.
struct PostureTangent {
  Eigen::Vector3d waist{0, 0, 0};         ///< of B's origin, in W [m]
  double waist_yaw = 0.0;                 ///< [rad]
  std::array<Eigen::Vector3d, 2> sole_B;  ///< of the sole's origin seen from B [m]; by Index(Side)
  std::array<Vector6d, 2> q;              ///< joint angles [rad]
  std::array<Vector6d, 2> speeds;         ///< joint speeds [rad/s]
};

/// The derivative of SolvePosture and SolveJointSpeeds along `tangent`, of which `value` and
/// `first` are used. Exact: δq = J⁻¹·δX, δq̇ = J⁻¹(δV − δJ·q̇). Precondition: the posture's joint
/// speeds are solved.
PostureTangent Differentiate(const RobotModel& robot, const WalkJet& jet, const Posture& posture,
                             const WalkJet& tangent);

/// The derivative, in W, of the place of a point that is fixed in a body and now at p_W [m].
Eigen::Vector3d PointTangent(const RobotBody& body, const Posture& posture,
                             const PostureTangent& tangent, const Eigen::Vector3d& p_W);

}  // namespace halfstep
