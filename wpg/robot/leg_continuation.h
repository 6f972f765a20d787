#pragma once

#include <Eigen/Geometry>

#include "wpg/robot/leg_rounding.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// How a sole moves, seen from the waist, for all t in [m − h, m + h]. It stays level. At rest by
/// default.
struct SoleDrift {
  double half_width = 0.0;            ///< h [s]
  Eigen::Vector3d velocity{0, 0, 0};  ///< of its origin, at m [m/s]
  double yaw_rate = 0.0;              ///< at m [rad/s]
  double acceleration = 0.0;          ///< of its origin, sup [m/s²]
  double yaw_acceleration = 0.0;      ///< sup [rad/s²]
  /// How far rounding may carry its pose and its twist at m; what they leave is not used.
  LegRounding::OfSole pose_off = {}, twist_off = {};

  /// sup of |dV/dt| [m/s²] of the linear part of the sole's twist V about the waist-fixed point
  /// `about` when the sole is at p_BSole at m.
  double TwistRate(const Eigen::Vector3d& about, const Eigen::Vector3d& p_BSole) const;
};

/// Where the closed form leads a leg that has none.
struct LegContinuation {
  bool arrived = false;           ///< whether q reaches the sole's pose
  Vector6d q = Vector6d::Zero();  ///< [rad], not wrapped; means something only when arrived.
  /// Unless arrived, by how much that fails [m], > 0: reach of the closed-form leg, or the part of
  /// the offsets that could not be added.
  double missing = 0.0;
};

/// Joint angles that bring the sole of a leg without closed form to X_BSole: those of the
/// closed-form leg `met` in its branch, continued while its axes move to the leg's own and the sole
/// stays. That is the leg's branch: a function of the pose that is continuous wherever it is
/// defined, because a way with a regular Jacobian has one lift. Found step by step, where the lift
/// exists and stays near, and the next posture is on it. Deterministic; at most 64 steps. Source:
/// wpg/README.md, "Offset hips and ankles".
LegContinuation ContinueLeg(const Leg& leg, const Eigen::Isometry3d& X_BSole);

/// Whether the exact leg is proved to stay in its branch for every pose that the sole takes in an
/// interval; X_BSole is that at m and level, where the angles are `q` with an error of at most
/// `off` [rad]. Rounding is part of the proof.
bool StaysInBranch(const Leg& leg, const Eigen::Isometry3d& X_BSole, const SoleDrift& drift,
                   const Vector6d& q, const Vector6d& off);

}  // namespace halfstep
