#pragma once

#include <Eigen/Core>
#include <string>

#include "opt/problem/problem.h"
#include "opt/solvers/solution.h"
#include "opt/solvers/solver_options.h"

namespace halfstep::opt {

/// How best to use a solver that is called repeatedly on a problem that is refined between calls.
struct SolverTraits {
  /// It does better with many simple rows, few of them active, than with few smooth rows that each
  /// aggregate many.
  bool many_rows = false;
  /// Iterations per call; after these, refining the problem gains more than iterating on.
  int iterations = 30;
  /// SolverOptions::solver_options for problems whose cost and rows are nearly linear.
  std::map<std::string, std::string> nearly_linear = {};
};

/// One optimization algorithm behind the common interface. Solvers hold no state: Solve may be
/// called again and from several threads.
class Solver {
 public:
  virtual ~Solver() = default;

  virtual std::string name() const = 0;               ///< as SolverNames() lists it
  virtual SolverTraits traits() const { return {}; }  ///< how to use it in rounds
  /// Whether the solver is compiled in.
  virtual bool available() const = 0;
  /// A sentence that says why it is not compiled in; "" when it is.
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
