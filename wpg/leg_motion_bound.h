#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>

#include "wpg/leg_ik.h"
#include "wpg/robot_model.h"

namespace halfstep {

/// Distances [m] along a leg that no posture exceeds. Joint i's origin is the hip for joints 0–2,
/// the knee, the ankle for joints 4 and 5.
class LegExtents {
 public:
  explicit LegExtents(const Leg& leg);

  /// From joint i's origin to the sole frame's origin.
  double ToSole(int joint) const { return to_sole_[static_cast<size_t>(joint)]; }
  /// From joint i's origin to any point of a body of this leg: along the links between them, down
  /// the leg when i ≤ body.link, up the leg otherwise.
  double ToBody(int joint, const RobotBody& body) const;

 private:
  std::array<Eigen::Vector3d, 6> origin_B_;  // at q = 0
  std::array<Eigen::Isometry3d, 6> X_BLink_;
  std::array<double, 6> to_sole_;
};

/// Bounds of joint motion for all t in [m − h, m + h].
struct JointBounds {
  Vector6d speed;         ///< sup |q̇_i| [rad/s]
  Vector6d acceleration;  ///< sup |q̈_i| [rad/s²]
};

/// Bounds of the rate of change of the twist of the sole relative to the waist, seen from the
/// waist.
struct TwistRateBound {
  double angular = 0.0;  ///< sup ‖ω̇‖ [rad/s²]
  double linear = 0.0;   ///< sup ‖v̇‖ of the sole's origin [m/s²]
};

/// Joint bounds from the inverse Jacobian and the joint speeds at the midpoint: q̈ = J⁻¹(V̇ − J̇q̇),
/// with J(t)⁻¹ bounded by J(m)⁻¹ and how far J can have turned. A bootstrap: assumed bounds of |q̇|
/// imply smaller ones, which proves them. None when that does not close: h too long, or a leg too
/// nearly stretched. Source: smoothing/README.md, "Motion bounds".
std::optional<JointBounds> BoundJoints(const LegExtents& extents, const Matrix6d& jacobian_inverse,
                                       const Vector6d& speeds, const TwistRateBound& twist_rate,
                                       double half_width);

/// One joint of a chain, as seen from the chain's base.
struct ChainJoint {
  double speed = 0.0;         ///< sup |q̇| [rad/s]
  double acceleration = 0.0;  ///< sup |q̈| [rad/s²]
  double reach = 0.0;         ///< sup distance from the joint's origin to the point [m]
};
/// Bounds of a point's motion relative to the base of a chain.
struct PointBound {
  double speed = 0.0;         ///< [m/s]
  double acceleration = 0.0;  ///< [m/s²]
};
/// Joints in order from the base: v = Σ q̇ρ, a = Σ_i (q̈_i + q̇_i²)ρ_i + 2q̇_i·Σ_{j>i} q̇_jρ_j (Euler,
/// centripetal and Coriolis acceleration, frame by frame).
PointBound BoundChain(std::span<const ChainJoint> joints);

}  // namespace halfstep
