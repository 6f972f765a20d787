#pragma once

#include <Eigen/Core>
#include <vector>

namespace halfstep::verify {

/// The motion of the waist that a half-step adds to its CoM, by this checker's own formula: with
/// control points c_k [m] in W and m = c.size() + 3 pieces,
///
///     d(τ) = Σ_k c_k·B(m·τ/T − k),    B(u) = Σ_{j=0}^{4} (−1)^j·C(4, j)·max(0, u − j)³/6,
///
/// zero before τ = 0 and after T.
struct DescribedSway {
  std::vector<Eigen::Vector2d> control_points;  ///< [m], in order of time
  double duration = 1;                          ///< T [s] > 0

  /// d⁽ⁿ⁾(τ), n ∈ {0, 1, 2} [m/sⁿ].
  Eigen::Vector2d Derivative(int n, double tau) const;
  /// A bound of ‖d⃛‖ at all τ [m/s³]: it is the third difference of the control points, (m/T)³
  /// times.
  double ThirdBound() const;
};

}  // namespace halfstep::verify
