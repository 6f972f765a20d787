#include <cmath>
#include <exception>

#include "opt/problem/require.h"
#include "opt/solvers/solve_monitor.h"

namespace halfstep::opt {
namespace {

std::string WhyRefused(const Solver& solver, const Problem& problem, const Eigen::VectorXd& x0,
                       const SolverOptions& options) {
  if (!solver.available()) return solver.WhyUnavailable();
  if (problem.num_variables() == 0) return "The problem has no variables.";
  for (Eigen::Index j = 0; j < x0.size(); ++j) {
    if (std::isfinite(x0[j])) continue;
    return "At the start: " + problem.VariableName(static_cast<int>(j)) + " is not finite.";
  }
  if (!(options.feasibility_tolerance > 0.0)) return "feasibility_tolerance must be positive.";
  if (!(options.optimality_tolerance > 0.0)) return "optimality_tolerance must be positive.";
  if (options.max_iterations < 1) return "max_iterations must be at least 1.";
  if (options.max_evaluations < 1) return "max_evaluations must be at least 1.";
  if (!(options.deadline >= 0.0)) return "deadline must not be negative.";
  return solver.WhyUnsupported(problem);
}

}  // namespace

Solution MonitoredSolve(
    const Solver& solver, const Problem& problem, const Eigen::VectorXd& x0,
    const SolverOptions& options, SolveMonitor::Iterations counting,
    const std::function<SolverEnd(SolveMonitor&, const Eigen::VectorXd&)>& run) {
  Require(x0.size() == problem.num_variables(), "x0 has " + std::to_string(x0.size()) +
                                                    " entries, not " +
                                                    std::to_string(problem.num_variables()));
  SolveMonitor monitor(problem, options, counting);
  SolverEnd end{Ending::kInvalidInput, WhyRefused(solver, problem, x0, options), {}};
  if (end.message.empty()) {
    const Eigen::VectorXd start = x0.cwiseMax(problem.lower()).cwiseMin(problem.upper());
    const bool fixed = problem.lower() == problem.upper();
    try {
      if (!monitor.Begin(start)) {
        // The monitor knows why.
      } else if (fixed) {
        end = {Ending::kConverged, "Every variable is fixed.", start};
      } else {
        end = run(monitor, start);
      }
    } catch (const std::exception& error) {
      end = {Ending::kFailed, std::string("The solver threw: ") + error.what(), {}};
    }
  }
  Solution solution = monitor.Finish(end.claim, end.message, end.x);
  solution.solver = solver.name();
  solution.warm_start = end.warm_start;
  return solution;
}

}  // namespace halfstep::opt
