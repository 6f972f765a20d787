#pragma once

#include <Eigen/Core>

namespace halfstep::opt {

/// Coordinate-wise smooth map z ∈ Rⁿ → x ∈ [lower, upper], so that a minimizer that knows no bounds
/// never leaves them:
///
///     both finite:   x = l + (u − l)·(1 + sin z)/2
///     only lower:    x = l − 1 + √(z² + 1)
///     only upper:    x = u + 1 − √(z² + 1)
///     none:          x = z
///
/// At a bound dx/dz = 0: a minimum on the bound is an ordinary stationary point in z, but so is any
/// other point on it, so a start should lie a little inside (OffTheBounds).
/// Source: [James1994], section 1.2.
class BoxTransform {
 public:
  /// The box (n), lower ≤ upper; either may be infinite.
  BoxTransform(Eigen::VectorXd lower, Eigen::VectorXd upper);

  /// The point of the box (n) that z (n) stands for.
  Eigen::VectorXd ToBox(const Eigen::VectorXd& z) const;
  /// An inverse image of x, which must lie in the box.
  Eigen::VectorXd FromBox(const Eigen::VectorXd& x) const;
  /// dx_j/dz_j (n).
  Eigen::VectorXd Slope(const Eigen::VectorXd& z) const;
  /// Moves coordinates of x off a bound: each that is nearer to it than `fraction` of the width (of
  /// max(1, |bound|) where only one side is bounded), and whose −gradient points inwards from it,
  /// is moved to that distance.
  Eigen::VectorXd OffTheBounds(const Eigen::VectorXd& x, const Eigen::VectorXd& gradient,
                               double fraction) const;

 private:
  Eigen::VectorXd lower_, upper_;
};

}  // namespace halfstep::opt
