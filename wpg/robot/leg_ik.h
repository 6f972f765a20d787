#pragma once

#include <vector>

#include "wpg/robot/robot_model.h"

namespace halfstep {

/// Outcome of the leg inverse kinematics.
enum class LegIkStatus {
  kSolved,                  ///< the sole is where it was asked to be, to rounding.
  kOutOfReach,              ///< hip and ankle are farther apart (or nearer) than the knee allows;
                            ///< without closed form: no posture could be proved.
  kUnreachableOrientation,  ///< ankle or hip axes, not orthogonal, cannot give the rotation.
};

/// Joint angles of a leg, or why there are none.
struct LegIkSolution {
  LegIkStatus status = LegIkStatus::kOutOfReach;  ///< what `q` is worth
  /// [rad], meaningless unless solved. Each wrapped to (−π, π]; without closed form not wrapped.
  Vector6d q = Vector6d::Zero();
  /// Stretched length − hip–ankle distance [m]; where hip and ankle are nearer to each other than
  /// the knee allows, their distance − the least that it allows. Without closed form, hip and ankle
  /// are the points `hip_B` on the thigh and `ankle_B` on the shank, and out of reach it is
  /// −LegContinuation::missing. Negative if and only if the status is kOutOfReach.
  double reach_margin = 0.0;
};

/// Joint angles of `leg` that bring its sole to X_BSole, in the leg's standing branch.
/// Precondition: a finite pose (std::logic_error). Closed form: knee from the hip–ankle distance,
/// ankles from the hip's direction seen from the foot, hip from the rotation that remains
/// (Paden–Kahan subproblems 3, 2, 2 and 1). A leg without closed form is continued from one
/// that has it (wpg/robot/leg_continuation.h).
/// Source: [Murray1994] §3.3; README of wpg, "Leg inverse kinematics".
LegIkSolution SolveLegIk(const Leg& leg, const Eigen::Isometry3d& X_BSole);
/// The same in a given branch. Precondition here and where branches are named: a closed form.
LegIkSolution SolveLegIk(const Leg& leg, const Eigen::Isometry3d& X_BSole, const LegBranch& branch);

/// The branch to which the posture q belongs. At a singularity (stretched knee, aligned hip or
/// ankle axes), where two branches meet, one of them.
LegBranch LegBranchOf(const Leg& leg, const Vector6d& q);

/// A solution and its branch.
struct LegIkBranchSolution {
  LegBranch branch;  ///< by the choices of the closed form
  Vector6d q;        ///< [rad]
};
/// All solutions, at most 8; none when the pose cannot be reached.
std::vector<LegIkBranchSolution> SolveLegIkAll(const Leg& leg, const Eigen::Isometry3d& X_BSole);

/// Geometric Jacobian (6×6) of the sole, per joint speed: the upper three rows are the sole's
/// angular velocity [rad/s], the lower three the velocity of its frame's origin [m/s], both seen
/// from B and expressed in B.
Matrix6d LegJacobian(const LegFrames& frames);
/// The same at joint angles q [rad].
Matrix6d LegJacobian(const Leg& leg, const Vector6d& q);

/// The hip–ankle distance as the knee alone changes it [m], and its derivative [m/rad]. The second
/// derivative is at most 2P/distance, the first at most √P, P the product of the two levers.
struct LegLength {
  /// At one angle of the knee [m], [m/rad]; product: P [m²].
  double distance = 0.0, slope = 0.0, product = 0.0;
};
/// At the knee's angle [rad], which the other joints do not change.
LegLength LegLengthAt(const Leg& leg, double knee);

/// The inverse of LegJacobian (6×6). Referred to the hip, where the three hip axes meet, J has the
/// 3×3 blocks [A B; 0 C], so two small inverses suffice. Returns false, and does not write
/// `inverse`, when J is singular: |det J| ≤ 1e-7·L³, with L the stretched leg's length.
[[nodiscard]] bool InvertLegJacobian(const Leg& leg, const LegFrames& frames, Matrix6d* inverse);

/// Derivative of the joint angles [rad] (6×8) when an upright waist and a flat sole move in x, y, z
/// [m] and yaw [rad] of W. Columns: waist x, y, z, yaw, sole x, y, z, yaw. Preconditions: `X_WB`
/// and `X_WSole` are upright, and q are the angles that join them. Returns false, and does not
/// write `dq`, where InvertLegJacobian does so.
[[nodiscard]] bool LegIkDerivative(const Leg& leg, const Vector6d& q, const Eigen::Isometry3d& X_WB,
                                   const Eigen::Isometry3d& X_WSole,
                                   Eigen::Matrix<double, 6, 8>* dq);

}  // namespace halfstep
