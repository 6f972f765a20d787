#pragma once

#include <Eigen/Core>
#include <string>

#include "opt/problem/problem.h"
#include "opt/solvers/solution.h"
#include "opt/solvers/solver_options.h"

namespace halfstep::opt {

/// What suits a solver that is called again and again on a problem of which each call shows more.
struct SolverTraits {
  /// Many rows, each of one thing, of which few matter at a time, are better than few smooth rows
  /// that gather many.
  bool many_rows = false;
  /// Gets far in a few iterations where there is room, so that it need not begin near the end.
  bool long_steps = false;
  /// Iterations of one call, after which a look at the problem is worth more than a further one.
  int iterations = 30;
  /// SolverOptions::solver_options where cost and rows are nearly linear.
  std::map<std::string, std::string> nearly_linear = {};
};

/// One algorithm behind the one door. Solvers hold no state: Solve may be called again and from
/// several threads.
class Solver {
 public:
  virtual ~Solver() = default;

  virtual std::string name() const = 0;
  virtual SolverTraits traits() const { return {}; }
  /// Compiled in?
  virtual bool available() const = 0;
  /// A sentence; "" when available.
  virtual std::string WhyUnavailable() const = 0;
  /// A sentence that says why this solver cannot take the problem; "" when it can.
  virtual std::string WhyUnsupported(const Problem& problem) const = 0;
  /// Minimizes from x0 (n), which is first projected onto the variables' bounds. Never throws for
  /// what blocks throw or solvers do: every ending is a status with a sentence. x0 of a wrong size
  /// is a std::logic_error.
  [[nodiscard]] virtual Solution Solve(const Problem& problem, const Eigen::VectorXd& x0,
                                       const SolverOptions& options) const = 0;
};

}  // namespace halfstep::opt
