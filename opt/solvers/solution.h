#pragma once

#include <Eigen/Core>
#include <exception>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "opt/solvers/ending.h"
#include "opt/solvers/warm_start.h"

namespace halfstep::opt {

/// One iteration of a solve.
struct HistoryEntry {
  int iteration;     ///< from 0
  double cost;       ///< at the iterate
  double violation;  ///< largest, in natural units; 0 when feasible
  double wall;       ///< [s] since Solve began
};

/// The result of a solve. x, cost, max_violation and worst_row belong together and were evaluated
/// by us: the solver's word is not taken for any of them, nor for `ending`.
struct Solution {
  /// kConverged: x is feasible to the tolerance, and by our own estimate it satisfies the
  /// first-order conditions. kLimit: a limit was reached, or x is feasible and nearly satisfies
  /// these conditions although the solver did not converge to it (its own test was weaker, it broke
  /// off or it ended elsewhere). kInterrupted: by stop token or on_iterate. kFailed: also when the
  /// solver's claim does not hold, nothing feasible was found or the cost is unbounded. Never
  /// kNoImprovement: only the caller, who knows what x0 was, can say that.
  Ending ending = Ending::kNotRun;
  std::string message = "Solve was not called.";  ///< how it ended, for people
  std::string solver;                             ///< "nlopt/ccsaq"
  /// The best point seen (n): the cheapest among those feasible to the tolerance, else the least
  /// violated; empty when none was evaluated.
  Eigen::VectorXd x;
  double cost = std::numeric_limits<double>::quiet_NaN();          ///< at x
  double max_violation = std::numeric_limits<double>::infinity();  ///< natural unit of worst_row
  std::string worst_row;                                           ///< "" when nothing is violated
  int iterations = 0;                                              ///< of the solver
  long cost_evaluations = 0;        ///< of the problem during this call of Solve
  long gradient_evaluations = 0;    ///< as cost_evaluations
  long constraint_evaluations = 0;  ///< as cost_evaluations
  long jacobian_evaluations = 0;    ///< as cost_evaluations
  /// Work of the solver's linear algebra during this call: multiplications of its factorizations,
  /// about. The same in every run, as far as the library repeats itself. Of libraries, whose
  /// factors are not seen: an estimate (SolveMonitor::EstimateAlgebra).
  long linear_algebra = 0;
  double wall = 0.0;                            ///< [s]
  std::vector<HistoryEntry> history;            ///< one entry an iteration
  std::shared_ptr<const WarmStart> warm_start;  ///< null when the solver provides none
  /// SolverOptions::solver_options as they were given.
  std::map<std::string, std::string> requested_options;
  std::map<std::string, std::string> used_options;  ///< as handed to the library

  /// Where the solver itself ended, which may be worse than x.
  Eigen::VectorXd final_x;
  double final_cost = std::numeric_limits<double>::quiet_NaN();  ///< at final_x
  /// At final_x, as max_violation.
  double final_violation = std::numeric_limits<double>::infinity();

  /// How far x is from the first-order conditions, and the multipliers (m, n) that fit them best,
  /// all by our own estimate (stationarity.h). NaN and empty where no estimate is made: after
  /// limits, stops and exceptions, and when x is not feasible.
  double stationarity = std::numeric_limits<double>::quiet_NaN();
  Eigen::VectorXd multipliers;        ///< of the rows, at x (m); signs as in stationarity.h
  Eigen::VectorXd bound_multipliers;  ///< of the variables' bounds, at x (n)

  bool feasible = false;         ///< whether x is feasible to the tolerance of the solve
  std::exception_ptr exception;  ///< what a block or on_iterate threw; null when nothing

  std::string BriefReport() const;  ///< one line
  std::string FullReport() const;   ///< a page: counts, times, options
};

}  // namespace halfstep::opt
