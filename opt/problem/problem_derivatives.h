#pragma once

#include <Eigen/Core>
#include <string>

#include "opt/problem/derivative_check.h"
#include "opt/problem/problem.h"

namespace halfstep::opt {

/// Result of comparing all of a problem's derivatives with central differences.
struct ProblemDerivativeReport {
  DerivativeReport cost;         ///< its row is 0
  DerivativeReport constraints;  ///< of all rows, stacked
  std::string message;           ///< names the worst row and variable, both values

  /// Whether both have passed.
  bool Passed(double tolerance) const {
    return cost.Passed(tolerance) && constraints.Passed(tolerance);
  }
};

/// Compares gradient and Jacobian at x (n) with the differences of CheckJacobian. An entry that the
/// pattern does not declare counts as 0, so a forgotten one is found as well.
ProblemDerivativeReport CheckDerivatives(const Problem& problem, const Eigen::VectorXd& x,
                                         double step = 1e-4);

}  // namespace halfstep::opt
