#pragma once

#include <Eigen/Core>
#include <vector>

#include "opt/problem/problem.h"

namespace halfstep::opt {

/// Multipliers that fit the first-order conditions at a point best, and how well they fit.
struct Stationarity {
  /// ‖∇f + Jᵀλ + ν‖∞ / max(1, ‖∇f‖∞): 0 at a Karush–Kuhn–Tucker point.
  double residual = 0.0;
  /// λ (m), cost per natural unit of the row: ≥ 0 at an upper bound, ≤ 0 at a lower one, 0 where
  /// the row is not active. λ_i is minus the change of cost for one unit more of that bound.
  Eigen::VectorXd multipliers;
  Eigen::VectorXd bound_multipliers;  ///< ν (n), likewise for the bounds of the variables
  long multiplications = 0;           ///< that it took
};

/// Minimizes ‖∇f + Jᵀλ + ν‖² over the multipliers of active rows and bounds, those nearer than
/// `activity`·max(1, |bound|), subject to their signs, by sweeps of coordinate descent, O(nonzeros)
/// each. Where they have not converged after the last sweep the residual is an upper estimate.
/// Source: first-order conditions as in [Nocedal2006], chapter 12. `gradient` (n), `constraints`
/// (m) and `jacobian` are the problem's values at x.
Stationarity EstimateMultipliers(const Problem& problem, const Eigen::VectorXd& x,
                                 const Eigen::VectorXd& gradient,
                                 const Eigen::VectorXd& constraints,
                                 const std::vector<double>& jacobian, double activity = 1e-4);

}  // namespace halfstep::opt
