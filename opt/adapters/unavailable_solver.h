#pragma once

#include <string>
#include <utility>

#include "opt/solvers/solve_monitor.h"
#include "opt/solvers/solver.h"

namespace halfstep::opt {

/// Stands in for a solver that is not compiled in and says why; Solve ends in kInvalidInput.
class UnavailableSolver : public Solver {
 public:
  /// `why` is a sentence for the user.
  UnavailableSolver(std::string name, std::string why)
      : name_(std::move(name)), why_(std::move(why)) {}

  std::string name() const override { return name_; }  ///< as it would be called if it were there
  bool available() const override { return false; }
  std::string WhyUnavailable() const override { return why_; }
  std::string WhyUnsupported(const Problem&) const override { return why_; }
  Solution Solve(const Problem& problem, const Eigen::VectorXd& x0,
                 const SolverOptions& options) const override {
    return MonitoredSolve(*this, problem, x0, options, SolveMonitor::Iterations::kTold,
                          [this](SolveMonitor&, const Eigen::VectorXd&) {
                            return SolverEnd{Ending::kInvalidInput, why_, {}};
                          });
  }

 private:
  std::string name_, why_;
};

}  // namespace halfstep::opt
