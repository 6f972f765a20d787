#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "opt/solvers/limited_memory_hessian.h"

namespace halfstep::opt {

/// The quadratic program of a step d (n) with rows that may be violated at a price,
///
///     minimize    gᵀd + ½ dᵀBd + Σ_i ν_i max(0, −(c + A d)_i)
///     subject to  lower ≤ d ≤ upper
///
/// B ≥ 0 as a LimitedMemoryHessian estimates it, ν_i > 0, lower < upper finite. Always solvable.
struct ElasticSubproblem {
  const LimitedMemoryHessian& hessian;   ///< B; borrowed
  Eigen::VectorXd g;                     ///< (n)
  const Eigen::SparseMatrix<double>& A;  ///< (m×n); borrowed
  Eigen::VectorXd c;                     ///< (m)
  Eigen::VectorXd lower, upper;          ///< (n)
  Eigen::VectorXd penalty;               ///< ν (m)
  /// How far the step's cost may be from the least, of how much it saves on d = 0. With 0, and
  /// where next to nothing can be saved, the step is as exact as rounding lets it be.
  double gap = 0.0;
};

/// The step that solves the subproblem.
struct ElasticStep {
  Eigen::VectorXd d;      ///< (n), within its bounds
  Eigen::VectorXd duals;  ///< of the rows (m), each in [0, ν_i]
  double gap;             ///< what its cost exceeds the least one by at most, up to rounding
  long linear_algebra;    ///< multiplications of factorizations, as Solution::linear_algebra
};

/// Solves it, without the rows that no step within the bounds can violate, by a primal-dual
/// interior point method with Mehrotra's corrector; O(n + m) an iteration when A is banded. Ends
/// within `gap`, at a complementarity of 1e-10 ‖g‖∞ times the largest width, or after 60
/// iterations, and returns the step reached. Source: opt/README.md, "halfstep/sqp".
ElasticStep Solve(const ElasticSubproblem& problem);

/// Σ_i max(0, −v_i).
double TotalViolation(const Eigen::VectorXd& v);

}  // namespace halfstep::opt
