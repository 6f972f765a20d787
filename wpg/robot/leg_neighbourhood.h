#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>

#include "wpg/robot/robot_model.h"

namespace halfstep {

/// What the sole asks of a leg's six joints around one posture, for any geometry of the leg. The
/// leg may be on the way to its own from that of its closed-form neighbour `Leg::met`: with a share
/// s of the offsets, joints and sole are at met + s·(leg − met) at q = 0. Twists are about the
/// waist-fixed point `Leg::hip_B`: three angular velocities [rad/s], then the velocity [m/s] of the
/// sole's point that is just there, all seen from B. "Ways" are integrals of absolute joint speeds
/// [rad]. Bounds are of the exact leg: Y = inverse() is what was computed, and what rounding may do
/// to all else is in them. Source: wpg/README.md, "Offset hips and ankles".
class LegNeighbourhood {
 public:
  /// None where the Jacobian is singular: |det J| ≤ 1e-7·L³, with L the leg's length.
  static std::optional<LegNeighbourhood> Around(const Leg& leg, const Vector6d& q,
                                                double share = 1.0);

  const Eigen::Isometry3d& X_BSole() const { return X_BSole_; }  ///< of the sole, at the middle
  /// Y, joint speeds per twist of the sole.
  const Matrix6d& inverse() const { return inverse_; }
  /// How the joints turn while the share grows and the sole stays [rad].
  const Vector6d& by_share() const { return by_share_; }
  /// Joint accelerations [rad/s²] at these joint speeds [rad/s] when the twist does not change.
  Vector6d Bend(const Vector6d& speeds) const;

  /// A bound of |Y·J − 1|, entry by entry, where joints are within `radius` [rad] and the share
  /// within `share` of here.
  Matrix6d Change(const Vector6d& radius, double share = 0.0) const;
  /// Bounds of |Y·J̇·q̇| [rad/s²] for joint speeds of at most `speeds` within `radius`.
  Vector6d Bending(const Vector6d& speeds, const Vector6d& radius) const;
  /// Bounds of |Y·V| for twists V about the vertical by at most `yaw` and of the point by at most
  /// `velocity`.
  Vector6d Asked(double yaw, double velocity) const;
  /// The same about any axis, by at most `turn`.
  Vector6d AskedAnyWay(double turn, double velocity) const;
  /// How far rounding may carry Y times the twist of a way of less than π from the sole's exact
  /// pose here [rad].
  Vector6d WayRounding() const { return AskedAnyWay(6.0 * turn_off_, 10.0 * place_off_); }
  /// The same of by_share() [rad].
  Vector6d ByShareRounding() const { return share_off_ * linear_; }

  /// Bounds of the joints' ways while the share grows by `share` and the sole goes along a path
  /// that begins at its pose here, where `asked` bounds ∫|Y·V|. None: the proof fails. Where there
  /// is a result, the path has a lift into joint space, J stays regular along it, and it differs
  /// from share·by_share + ∫Y·V by at most result − asked − share·|by_share|.
  std::optional<Vector6d> Ways(const Vector6d& asked, double share = 0.0) const;
  /// A bound of |Y·vee(∂F/∂q·F(here)⁻¹) − 1|, entry by entry, within `radius`, for the sole's
  /// pose F as a 4×4 matrix; vee takes the antisymmetric part's vector, then the last column.
  /// Precondition: the radii's sum is below 1.
  Matrix6d PoseChange(const Vector6d& radius) const;
  /// Whether no two postures within `radius` of here have one pose of the sole.
  bool InjectiveWithin(const Vector6d& radius) const;

 private:
  static constexpr int kPairs = 15;  // of joints l < j, at j(j − 1)/2 + l

  void Place(const Leg& leg, const Vector6d& q, double share, Matrix6d* J);

  Eigen::Isometry3d X_BSole_;
  Matrix6d inverse_;
  Eigen::Matrix<double, 6, kPairs> brackets_;  // Y[ξ_l, ξ_j]: how ξ_j changes when l turns
  Vector6d angular_, linear_;                  // norms of the two halves of Y's rows
  Vector6d by_share_;
  Matrix6d share_change_;  // Y times what J changes by per unit of share
  // For any posture and share: distance of each axis from the point, at most, and sums of the
  // offsets of the links before the joint (6: and of the foot) [m].
  Vector6d lever_;
  std::array<double, 7> offset_;
  // Of rounding: axes' directions [rad], points and axes' moments [m], changes by the share [m],
  // the bound of |Y·J − 1| here, and brackets_.
  double turn_off_ = 0.0, place_off_ = 0.0, share_off_ = 0.0;
  Matrix6d off_;
  Vector6d brackets_off_;
};

/// A positive vector v and a share < 1 with M·v ≤ share·v, for a matrix M ≥ 0: then its spectral
/// radius is below 1.
struct Contraction {
  Vector6d weights;    ///< v > 0 (6)
  double share = 0.0;  ///< < 1
  /// None when none is found.
  static std::optional<Contraction> Of(const Matrix6d& M);
  /// An upper bound of (I − M)⁻¹·u, u ≥ 0.
  Vector6d Resolve(const Matrix6d& M, const Vector6d& u) const;
};

}  // namespace halfstep
