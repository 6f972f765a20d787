#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>

namespace halfstep {

/// Result of comparing a Jacobian with central differences.
struct DerivativeReport {
  double worst_error =
      0.0;                ///< |analytic − numeric| / (1 + |numeric| + |analytic|), largest entry.
  int row = -1;           ///< of the worst entry; −1: nothing was compared
  int column = -1;        ///< its column
  double analytic = 0.0;  ///< of that entry
  double numeric = 0.0;   ///< of that entry, by central differences
  bool finite = true;     ///< false when any value or derivative is not finite

  /// Whether all is finite and no entry is worse than `tolerance`.
  bool Passed(double tolerance) const { return finite && worst_error <= tolerance; }
  /// "row 3, column 1: analytic 2.0, numeric 1.5".
  std::string Describe() const;
};

/// Compares `jacobian` (m×n) at x (n) with fourth-order central differences of `function` (n → m),
/// [f(x−2h) − 8f(x−h) + 8f(x+h) − f(x+2h)]/(12h), step h = `step`·max(1, |x_j|): the error of the
/// differences is O(h⁴) + ε·|f|/h. Precondition: sizes agree (std::logic_error).
DerivativeReport CheckJacobian(
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& function,
    const Eigen::VectorXd& x, const Eigen::MatrixXd& jacobian, double step = 1e-4);

}  // namespace halfstep
