#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "wpg/motion/motion_bounds.h"
#include "wpg/motion/vector_ball.h"

namespace halfstep {

/// Thigh and shank of one leg, the one hanging on the waist and the other on the sole, whose motion
/// must be the same at the knee: J q = the twist that is missing there, with the leg's Jacobian J
/// for twists about the knee's point. For q̇, q̈ and q⃛ alike, for both kinds of legs. In the axes of
/// W. Source: smoothing/README.md, "The robot's ZMP between instants".
class KneeMatch {
 public:
  /// Precondition: `motion` is bounded.
  KneeMatch(const IntervalMotion& motion, Side side);

  /// Of the six joints' axes at the interval's midpoint m, in W [m].
  const std::array<Eigen::Vector3d, 6>& points() const { return points_; }
  /// Between the points of two joints at m, or more, by rounding [m].
  double Distance(size_t i, size_t j) const {
    return (points_[i] - points_[j]).norm() + distance_off_;
  }

  /// J(m)⁻¹ of a missing twist: its turning, and the velocity of the knee's point.
  Vector6d Joints(const Eigen::Vector3d& turn, const Eigen::Vector3d& velocity) const {
    return by_turn_ * turn + by_velocity_ * velocity;
  }
  /// Bounds of the absolute values of that for twists of at most these norms.
  Vector6d Most(double turn, double velocity) const {
    return turn * turn_norms_ + velocity * velocity_norms_;
  }
  /// A bound of every entry of |1 − Y J(t)|, Y the computed J(m)⁻¹, when links have turned by no
  /// more than `turned` since m (by link, from the hip down) [rad].
  Matrix6d Change(const std::array<double, 6>& turned) const;

  /// Bounds of all |x| for which J(t)·x has at most these norms, while links have turned by no more
  /// than `turned` since m: none above `bound`, of which it is known already that it is one.
  Vector6d Lowered(Vector6d bound, double turn, double velocity,
                   const std::array<double, 6>& turned) const;

  /// Vectors that are off `center` by no more than `radius`, entry by entry.
  struct JointBall {
    Vector6d center, radius;  ///< any, ≥ 0
  };
  /// All x for which J(t)·x is in these balls, while links have turned by no more than `turned`
  /// since m. None where links turn too far for that.
  std::optional<JointBall> Solve(const VectorBall& turn, const VectorBall& velocity,
                                 const std::array<double, 6>& turned) const;

 private:
  std::array<Eigen::Vector3d, 6> points_;
  Eigen::Matrix<double, 6, 3> by_turn_, by_velocity_;
  Vector6d turn_norms_, velocity_norms_;  // of their rows
  Vector6d off_;                          // of |1 − Y J(m)|, in every column of a row
  double distance_off_ = 0.0;
};

}  // namespace halfstep
