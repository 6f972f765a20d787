#include "opt/adapters/function_solver.h"

#include <utility>

namespace halfstep::opt {
namespace {

class FunctionSolver : public Solver {
 public:
  FunctionSolver(std::string name, Minimize minimize)
      : name_(std::move(name)), minimize_(std::move(minimize)) {}

  std::string name() const override { return name_; }
  bool available() const override { return true; }
  std::string WhyUnavailable() const override { return ""; }
  std::string WhyUnsupported(const Problem&) const override { return ""; }
  Solution Solve(const Problem& problem, const Eigen::VectorXd& x0,
                 const SolverOptions& options) const override {
    return MonitoredSolve(
        *this, problem, x0, options, SolveMonitor::Iterations::kImprovements,
        [this](SolveMonitor& monitor, const Eigen::VectorXd& start) {
          return SolverEnd{Ending::kLimit, "The function returned.", minimize_(monitor, start)};
        });
  }

 private:
  const std::string name_;
  const Minimize minimize_;
};

}  // namespace

std::unique_ptr<Solver> MakeFunctionSolver(const std::string& name, Minimize minimize) {
  return std::make_unique<FunctionSolver>(name, std::move(minimize));
}

}  // namespace halfstep::opt
