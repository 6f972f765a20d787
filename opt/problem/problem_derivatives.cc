#include "opt/problem/problem_derivatives.h"

namespace halfstep::opt {

ProblemDerivativeReport CheckDerivatives(const Problem& problem, const Eigen::VectorXd& x,
                                         double step) {
  ProblemDerivativeReport report;
  report.cost = CheckJacobian(
      [&](const Eigen::VectorXd& p) { return Eigen::VectorXd::Constant(1, problem.Cost(p)); }, x,
      problem.Gradient(x).transpose(), step);
  if (problem.num_constraints() > 0) {
    report.constraints =
        CheckJacobian([&](const Eigen::VectorXd& p) { return problem.Constraints(p); }, x,
                      problem.DenseJacobian(x), step);
  }
  const DerivativeReport& cost = report.cost;
  const DerivativeReport& rows = report.constraints;
  const bool worst_in_cost = !cost.finite || (rows.finite && cost.worst_error >= rows.worst_error);
  const DerivativeReport& worst = worst_in_cost ? cost : rows;
  report.message = (worst_in_cost ? std::string("cost") : problem.RowName(worst.row)) +
                   " with respect to " + problem.VariableName(worst.column) + ": " +
                   worst.Describe();
  return report;
}

}  // namespace halfstep::opt
