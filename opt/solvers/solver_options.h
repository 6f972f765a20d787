#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <stop_token>
#include <string>

#include "opt/solvers/warm_start.h"

namespace halfstep::opt {

/// The argument of on_iterate; valid during the call only.
struct Iterate {
  int iteration;             ///< from 0
  const Eigen::VectorXd& x;  ///< (n)
  double cost;               ///< at x
  double violation;          ///< largest, in natural units; 0 when feasible
  double wall;               ///< [s] since Solve began
};

/// Limits of one solve. The limits, `stop` and `on_iterate` hold for every solver; whether to stop
/// is checked before each evaluation.
struct SolverOptions {
  /// Iterations as the solver counts them; for Ceres, those of all inner minimizations together.
  /// NLopt does not report iterations: each point better than all before it (less violated, or both
  /// within the tolerance and cheaper) counts as one, and only max_evaluations limits them.
  int max_iterations = 500;
  int max_evaluations = 20000;  ///< points at which anything is evaluated
  double deadline = std::numeric_limits<double>::infinity();  ///< [s] from the call of Solve
  /// Largest violation, in natural units, at which a point counts as feasible. Too small: nothing
  /// ever converges (rounding); too large: the answer lies outside by that much.
  double feasibility_tolerance = 1e-6;
  /// Relative tolerance that the solver's own test of optimality is given (Ipopt `tol`, NLopt
  /// ftol_rel and xtol_rel, Ceres' gradient tolerance).
  double optimality_tolerance = 1e-6;
  /// Asked before each evaluation with the Solution::linear_algebra of this solve so far; false:
  /// the solve ends as kLimit, its effort used. Null: always true. Must not throw.
  std::function<bool(long linear_algebra)> may_go_on = nullptr;
  /// When it is requested, the solve ends as kInterrupted with the best point so far.
  std::stop_token stop;
  std::function<bool(const Iterate&)> on_iterate;  ///< called at each iteration; false: stop
  /// Options passed through to the solver; an unknown or refused one ends in kInvalidInput.
  std::map<std::string, std::string> solver_options;
  /// Solution::warm_start of an earlier solve. Null or another solver's is ignored.
  std::shared_ptr<const WarmStart> warm_start = nullptr;
  unsigned seed = 1;  ///< for solvers that draw random numbers (nlopt/isres)
};

}  // namespace halfstep::opt
