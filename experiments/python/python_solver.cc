#include "experiments/python/python_solver.h"

#include <pybind11/eigen.h>

#include <stdexcept>
#include <utility>

#include "experiments/python/long_call.h"

namespace py = pybind11;

namespace halfstep::python {

opt::SolveMonitor& SolvingTask::monitor() const {
  if (monitor_ == nullptr) {
    throw std::invalid_argument("the solve has ended (valid: within the registered function)");
  }
  return *monitor_;
}

void SolvingTask::Require(const Eigen::VectorXd& x) const {
  const int n = problem().num_variables();
  if (x.size() != n) {
    throw std::invalid_argument("x: " + std::to_string(x.size()) +
                                " numbers (valid: " + std::to_string(n) + ")");
  }
}

double SolvingTask::Cost(const Eigen::VectorXd& x) const {
  Require(x);
  double cost = 0.0;
  if (!monitor().Cost(x, &cost)) throw SolveStopped("the solve is to end");
  return cost;
}

Eigen::VectorXd SolvingTask::Gradient(const Eigen::VectorXd& x) const {
  Require(x);
  Eigen::VectorXd gradient;
  if (!monitor().Gradient(x, &gradient)) throw SolveStopped("the solve is to end");
  return gradient;
}

Eigen::VectorXd SolvingTask::Constraints(const Eigen::VectorXd& x) const {
  Require(x);
  Eigen::VectorXd values;
  if (!monitor().Constraints(x, &values)) throw SolveStopped("the solve is to end");
  return values;
}

std::vector<double> SolvingTask::Jacobian(const Eigen::VectorXd& x) const {
  Require(x);
  std::vector<double> nonzeros;
  if (!monitor().Jacobian(x, &nonzeros)) throw SolveStopped("the solve is to end");
  return nonzeros;
}

namespace {

class PythonSolver : public opt::Solver {
 public:
  PythonSolver(std::string name, py::handle function)
      : name_(std::move(name)), function_(function) {}

  std::string name() const override { return name_; }
  bool available() const override { return true; }
  std::string WhyUnavailable() const override { return ""; }
  std::string WhyUnsupported(const opt::Problem&) const override { return ""; }

  opt::Solution Solve(const opt::Problem& problem, const Eigen::VectorXd& x0,
                      const opt::SolverOptions& options) const override {
    return opt::MonitoredSolve(*this, problem, x0, options,
                               opt::SolveMonitor::Iterations::kImprovements,
                               [this](opt::SolveMonitor& monitor, const Eigen::VectorXd& start) {
                                 return Call(&monitor, start);
                               });
  }

 private:
  opt::SolverEnd Call(opt::SolveMonitor* monitor, const Eigen::VectorXd& start) const {
    const py::gil_scoped_acquire acquired;
    const auto task = std::make_shared<SolvingTask>(monitor);
    opt::SolverEnd end{opt::Ending::kConverged, name_ + ": the function returned.", start};
    try {
      const auto x =
          py::reinterpret_borrow<py::function>(function_)(task, start).cast<Eigen::VectorXd>();
      if (x.size() != start.size() || !x.allFinite()) {
        throw std::invalid_argument("solver " + name_ + ": returned no x of " +
                                    std::to_string(start.size()) + " finite numbers");
      }
      end.x = x.cwiseMax(monitor->problem().lower()).cwiseMin(monitor->problem().upper());
    } catch (py::error_already_set& error) {
      const py::object stopped = py::module_::import("halfstep.errors").attr("SolveStopped");
      end.claim = opt::Ending::kFailed;
      if (!error.matches(stopped)) {
        end.message = name_ + ": " + error.what();
        KeepPythonError(error);
      }
    } catch (const std::exception& error) {  // what it returned is no x
      end.claim = opt::Ending::kFailed;
      end.message = error.what();
      PyErr_SetString(PyExc_ValueError, error.what());
      KeepPythonError(py::error_already_set());
    }
    task->End();
    return end;
  }

  std::string name_;
  py::handle function_;
};

}  // namespace

std::unique_ptr<opt::Solver> MakePythonSolver(const std::string& name, py::handle function) {
  return std::make_unique<PythonSolver>(name, function);
}

}  // namespace halfstep::python
