#include "experiments/python/python_smoother.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "experiments/python/long_call.h"
#include "smoothing/methods/solver_method_options.h"

namespace py = pybind11;

namespace halfstep::python {

SmoothingTask::SmoothingTask(const WalkProblem& problem, const MethodOptions& options,
                             NamedOptions own, SmoothingMonitor* monitor)
    : setting_(std::make_shared<const WalkSetting>(WalkSetting{problem, {}})),
      options_(options),
      own_(std::move(own)),
      monitor_(monitor) {}

SmoothingMonitor& SmoothingTask::monitor() const {
  if (monitor_ == nullptr) {
    throw std::invalid_argument("the method has ended (valid: within the registered function)");
  }
  return *monitor_;
}

double SmoothingTask::remaining() const {
  return stopped() ? 0.0 : std::max(0.0, monitor_->deadline() - monitor_->Seconds());
}

HomotopyParameters SmoothingTask::incumbent() const { return monitor().incumbent(); }
double SmoothingTask::duration() const { return monitor().duration(); }
bool SmoothingTask::Propose(const HomotopyParameters& candidate) {
  return monitor().Propose(candidate);
}
void SmoothingTask::Tell(double done) const { monitor().Progress(done); }

namespace {

class PythonSmoother : public Smoother {
 public:
  PythonSmoother(std::string meaning, OptionGroup<NamedOptions> own, const py::function& function)
      : meaning_(std::move(meaning)), own_(std::move(own)), function_(function.inc_ref()) {}

  std::string name() const override { return own_.key; }
  std::string meaning() const override { return meaning_; }
  std::vector<DeclaredGroup> groups() const override {
    if (own_.defaults.empty()) return {OptimizerGroup()};
    return {own_, OptimizerGroup()};
  }
  void DeclareRequest(Fields& fields, MethodOptions options) const override {
    DeclareSolverRequest(fields, options.Get(OptimizerGroup()));
    if (own_.defaults.empty()) return;
    fields.Group("own", {}, [&](Fields& f) { DeclareFields(f, &options.Edit(own_)); });
  }

  SmoothingResult Smooth(const WalkProblem& problem, const MethodOptions& options,
                         SmoothingMonitor& monitor) const override {
    const OptimizerOptions limits = options.Get(OptimizerGroup()).options;
    monitor.LimitTo(limits.effort, limits.deadline);
    if (!monitor.BeginFeasibly(problem, problem.Start())) return monitor.Refusal();
    const std::string failure = Call(problem, options, &monitor);
    if (monitor.stopped()) {
      return monitor.FinishAgainstStart(monitor.StopEnding(), monitor.StopReason(),
                                        ", nothing shorter than the start was proved");
    }
    if (!failure.empty()) return monitor.Finish(opt::Ending::kFailed, failure);
    return monitor.FinishAgainstStart(opt::Ending::kConverged, "the function returned",
                                      ", nothing shorter than the start was proved");
  }

 private:
  // "" or what the function raised.
  std::string Call(const WalkProblem& problem, const MethodOptions& options,
                   SmoothingMonitor* monitor) const {
    const py::gil_scoped_acquire acquired;
    const auto task = std::make_shared<SmoothingTask>(problem, options, options.Get(own_), monitor);
    std::string failure;
    try {
      py::reinterpret_borrow<py::function>(function_)(task);
    } catch (const py::error_already_set& error) {
      failure = error.what();
      failure.erase(std::min(failure.size(), failure.find("\n\nAt:\n")));  // no traceback
      KeepPythonError(error);
    }
    task->End();
    return failure;
  }

  std::string meaning_;
  OptionGroup<NamedOptions> own_;  // by the name of the method
  py::handle function_;
};

}  // namespace

std::unique_ptr<const Smoother> MakePythonSmoother(const std::string& name,
                                                   const std::string& meaning, NamedOptions options,
                                                   const py::function& function) {
  OptionGroup<NamedOptions> own{name, "options of " + name, std::move(options)};
  return std::make_unique<PythonSmoother>(meaning, std::move(own), function);
}

}  // namespace halfstep::python
