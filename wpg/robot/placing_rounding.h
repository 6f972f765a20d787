#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "wpg/rounded.h"

namespace halfstep {

/// ‖S‖, or more, of a matrix R(1 + S) that is nearly the rotation R, S symmetric.
template <typename Rotation>
double SkewOf(const Eigen::MatrixBase<Rotation>& R) {
  // Of RᵀR − 1, which is symmetric.
  const Eigen::Vector3d x = R.col(0), y = R.col(1), z = R.col(2);
  const double xy = x.dot(y), yz = y.dot(z), zx = z.dot(x);
  const double xx = x.dot(x) - 1.0, yy = y.dot(y) - 1.0, zz = z.dot(z) - 1.0;
  return 0.5 * std::sqrt(xx * xx + yy * yy + zz * zz + 2.0 * (xy * xy + yz * yz + zx * zx)) +
         16.0 * kRoundoff;
}

/// How far directions may be from those of the exact leg at the same angles, where each joint turns
/// about an axis that those before it have turned. R(1 + S) stands for a rotation R; a joint
/// carries R along, but for what S does to its axis and to turning about that, |sin q| + 2(1 − cos
/// q) times as much. Source: smoothing/README.md, "Rounding", 3.
class PlacingRounding {
 public:
  /// A joint turned by `angle` [rad], after which a matrix that it turned has that `skew`.
  void Turned(double angle, double skew) {
    angle = std::abs(angle);
    turn_ += std::min(angle + angle * angle, 4.3) * skew_ + OfTurn(angle);
    skew_ = skew;
    most_ = std::max(most_, skew);
  }
  /// The first joint: it turns a matrix that is exact, so no column of it is off by more.
  void TurnedFirst(double angle) { Turned(angle, 2.0 * OfTurn(std::abs(angle))); }
  /// Of any direction that was turned so far [rad].
  double turn() const { return turn_ + most_; }

 private:
  static double OfTurn(double angle) { return (24.0 + 40.0 * std::min(angle, 1.3)) * kRoundoff; }

  double turn_ = 0.0, skew_ = 0.0, most_ = 0.0;
};

}  // namespace halfstep
