#include "opt/problem/derivative_check.h"

#include <cmath>

#include <stdexcept>

#include "opt/problem/plain_stream.h"

namespace halfstep {

std::string DerivativeReport::Describe() const {
  opt::PlainStream out;
  out << "row " << row << ", column " << column << ": analytic " << analytic << ", numeric "
      << numeric << ", relative error " << worst_error;
  return out.str();
}

DerivativeReport CheckJacobian(
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& function,
    const Eigen::VectorXd& x, const Eigen::MatrixXd& jacobian, double step) {
  if (jacobian.cols() != x.size()) throw std::logic_error("CheckJacobian: columns do not match x");
  DerivativeReport report;
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    const double h = step * std::max(1.0, std::abs(x[j]));
    const auto at = [&](double offset) {
      Eigen::VectorXd moved = x;
      moved[j] += offset;
      return function(moved);
    };
    const Eigen::VectorXd numeric = (at(-2 * h) - 8 * at(-h) + 8 * at(h) - at(2 * h)) / (12 * h);
    if (numeric.size() != jacobian.rows()) {
      throw std::logic_error("CheckJacobian: rows do not match the function");
    }
    for (Eigen::Index i = 0; i < numeric.size(); ++i) {
      const double a = jacobian(i, j), n = numeric[i];
      const double error = std::abs(a - n) / (1.0 + std::abs(a) + std::abs(n));
      if (!std::isfinite(error)) report.finite = false;
      if (report.row < 0 || error > report.worst_error || !std::isfinite(error)) {
        report.worst_error = error;
        report.row = static_cast<int>(i);
        report.column = static_cast<int>(j);
        report.analytic = a;
        report.numeric = n;
      }
    }
  }
  return report;
}

}  // namespace halfstep
