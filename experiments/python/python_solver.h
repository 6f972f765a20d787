#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>

#include "opt/solvers/solve_monitor.h"
#include "opt/solvers/solver.h"

namespace halfstep::python {

/// What a solver of the user's gets: a nonlinear program while the solver runs. Evaluations are
/// counted, and throw SolveStopped once a limit is reached or Ctrl-C came.
class SolvingTask {
 public:
  explicit SolvingTask(opt::SolveMonitor* monitor) : monitor_(monitor) {}

  const opt::Problem& problem() const { return monitor().problem(); }
  double Cost(const Eigen::VectorXd& x) const;
  Eigen::VectorXd Gradient(const Eigen::VectorXd& x) const;
  Eigen::VectorXd Constraints(const Eigen::VectorXd& x) const;
  std::vector<double> Jacobian(const Eigen::VectorXd& x) const;  ///< in the order of the pattern
  bool stopped() const { return monitor_ == nullptr || !monitor_->MayGoOn(); }
  double remaining() const { return stopped() ? 0.0 : monitor_->RemainingTime(); }
  void End() { monitor_ = nullptr; }

 private:
  opt::SolveMonitor& monitor() const;
  void Require(const Eigen::VectorXd& x) const;

  opt::SolveMonitor* monitor_;
};

/// Says that a solver of the user's is to end; halfstep.SolveStopped in Python.
struct SolveStopped : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A solver that is a Python function of a SolvingTask and x0, and returns x. `function` is kept
/// for ever. Needs the GIL.
std::unique_ptr<opt::Solver> MakePythonSolver(const std::string& name, pybind11::handle function);

}  // namespace halfstep::python
