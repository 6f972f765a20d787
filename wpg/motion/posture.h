#pragma once

#include <Eigen/Geometry>
#include <array>

#include "wpg/motion/walk_state.h"
#include "wpg/nth.h"
#include "wpg/robot/leg_ik.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// What the robot's body does at one instant of a walk: upright waist, flat soles, leg joints.
struct Posture {
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();   ///< the waist's pose in W; upright
  std::array<Eigen::Isometry3d, 2> X_WSole;                 ///< by Index(Side), as are the others
  std::array<LegIkSolution, 2> ik;                          ///< joint angles and reach
  std::array<LegFrames, 2> frames;                          ///< seen from B
  std::array<std::array<Eigen::Isometry3d, 7>, 2> X_WLink;  ///< leg links, and the sole last
  std::array<Matrix6d, 2> jacobian_inverse;  ///< joint speeds per twist of the sole in B
  std::array<Vector6d, 2> speeds;            ///< q̇ [rad/s]
  Eigen::Vector3d waist_velocity{0, 0, 0};   ///< of B's origin [m/s]
  bool reachable = false;                    ///< both legs solved

  /// The pose in W of one of the robot's bodies.
  const Eigen::Isometry3d& OfBody(const RobotBody& body) const {
    return body.leg < 0 ? X_WB : Nth(Nth(X_WLink, body.leg), body.link);
  }
};

/// Solves for poses and joint angles. The CoM is rigid in the waist frame: p_WB = c − R(yaw)·p_BC.
/// When a leg does not reach, `reachable` is false, and the joints and links of that leg mean
/// nothing.
Posture SolvePosture(const RobotModel& robot, const WalkState& x);

/// Fills `speeds`, `jacobian_inverse` and `waist_velocity` from the walk's first derivative.
/// Returns false when a leg is stretched to the singularity, where joint speeds have no bound.
/// Precondition: the posture is reachable.
[[nodiscard]] bool SolveJointSpeeds(const RobotModel& robot, const WalkJet& jet, Posture* posture);

}  // namespace halfstep
