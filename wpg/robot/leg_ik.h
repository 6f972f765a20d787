#pragma once

#include <vector>

#include "wpg/robot/robot_model.h"

namespace halfstep {

/// Outcome of the closed-form leg inverse kinematics.
enum class LegIkStatus {
  kSolved,                  ///< the sole is where it was asked to be, to rounding.
  kOutOfReach,              ///< hip and ankle are farther apart (or nearer) than the knee allows.
  kUnreachableOrientation,  ///< ankle or hip axes, not orthogonal, cannot give the rotation.
};

struct LegIkSolution {
  LegIkStatus status = LegIkStatus::kOutOfReach;
  Vector6d q = Vector6d::Zero();  ///< [rad], each wrapped to (−π, π]; meaningless unless solved.
  /// Stretched length − hip–ankle distance [m]. Negative if and only if the status is kOutOfReach;
  /// when hip and ankle are too near each other: their distance − the least one of the knee.
  double reach_margin = 0.0;
};

/// Joint angles of `leg` that bring its sole to X_BSole, in the leg's standing branch. Closed form:
/// knee from the hip–ankle distance, ankles from the hip's direction seen from the foot, hip from
/// the rotation that remains (Paden–Kahan subproblems 3, 2, 2 and 1).
/// Source: [Murray1994] §3.3; README of wpg, "Leg inverse kinematics".
LegIkSolution SolveLegIk(const Leg& leg, const Eigen::Isometry3d& X_BSole);
/// The same in a given branch.
LegIkSolution SolveLegIk(const Leg& leg, const Eigen::Isometry3d& X_BSole, const LegBranch& branch);

/// The branch to which the posture q belongs. At a singularity (stretched knee, aligned hip or
/// ankle axes), where two branches meet, one of them.
LegBranch LegBranchOf(const Leg& leg, const Vector6d& q);

/// All solutions (at most 8), each with its branch; empty when out of reach.
struct LegIkBranchSolution {
  LegBranch branch;
  Vector6d q;
};
std::vector<LegIkBranchSolution> SolveLegIkAll(const Leg& leg, const Eigen::Isometry3d& X_BSole);

/// Geometric Jacobian (6×6) of the sole in B: rows (angular velocity [rad/s], velocity of the point
/// of the sole frame's origin [m/s]), both expressed in B, per joint speed.
Matrix6d LegJacobian(const LegFrames& frames);
Matrix6d LegJacobian(const Leg& leg, const Vector6d& q);

/// Its inverse (6×6). Referred to the hip, where the three hip axes meet, J = [A B; 0 C] with 3×3
/// blocks: two small inverses. Returns false when J is singular (|det J| < 1e-7·L³, L the stretched
/// leg's length), then `inverse` is not written.
[[nodiscard]] bool InvertLegJacobian(const Leg& leg, const LegFrames& frames, Matrix6d* inverse);

/// Columns of dq/d(·) (6×8) for an upright waist and a flat sole, both moving in x, y, z [m] and
/// yaw [rad] of the world: (waist x y z yaw, sole x y z yaw). `X_WB` and `X_WSole` upright, and q
/// the posture that joins them. Returns false when the Jacobian is singular (stretched knee: |det|
/// below 1e-7 of the stretched length cubed), then `dq` is not written.
[[nodiscard]] bool LegIkDerivative(const Leg& leg, const Vector6d& q, const Eigen::Isometry3d& X_WB,
                                   const Eigen::Isometry3d& X_WSole,
                                   Eigen::Matrix<double, 6, 8>* dq);

}  // namespace halfstep
