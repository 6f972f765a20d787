#include "opt/adapters/ceres_solver.h"

#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <mutex>
#include <utility>

#include "opt/adapters/box_transform.h"
#include "opt/solvers/augmented_lagrangian.h"
#include "opt/solvers/option_text.h"
#include "opt/solvers/solve_monitor.h"

namespace halfstep::opt {
namespace {

// Of each Jacobian: it is only multiplied by, and the update of the (L-)BFGS matrix is as cheap.
constexpr int kCeresPasses = 2;

/// Ceres writes warnings to standard error through glog. While any of these lives, it does not.
class QuietGlog {
 public:
  QuietGlog() {
    const std::lock_guard lock(Mutex());
    if (Count()++ == 0) Before() = std::exchange(FLAGS_minloglevel, google::GLOG_FATAL);
  }
  ~QuietGlog() {
    const std::lock_guard lock(Mutex());
    if (--Count() == 0) FLAGS_minloglevel = Before();
  }
  QuietGlog(const QuietGlog&) = delete;
  QuietGlog& operator=(const QuietGlog&) = delete;

 private:
  static std::mutex& Mutex() {
    static std::mutex mutex;
    return mutex;
  }
  static int& Count() {
    static int count = 0;
    return count;
  }
  static int& Before() {
    static int level = 0;
    return level;
  }
};

/// z → L(x(z)).
class InnerFunction : public ceres::FirstOrderFunction {
 public:
  InnerFunction(const AugmentedLagrangian& lagrangian, const BoxTransform& box, int size)
      : lagrangian_(lagrangian), box_(box), size_(size) {}

  int NumParameters() const override { return size_; }

  bool Evaluate(const double* parameters, double* value, double* gradient) const override {
    const Eigen::VectorXd z = Eigen::Map<const Eigen::VectorXd>(parameters, size_);
    if (!z.allFinite()) return false;
    Eigen::VectorXd slope;
    if (!lagrangian_.Evaluate(box_.ToBox(z), value, gradient ? &slope : nullptr)) return false;
    if (gradient != nullptr) {
      Eigen::Map<Eigen::VectorXd>(gradient, size_) = slope.cwiseProduct(box_.Slope(z));
    }
    return true;
  }

 private:
  const AugmentedLagrangian& lagrangian_;
  const BoxTransform& box_;
  int size_;
};

class Reporter : public ceres::IterationCallback {
 public:
  explicit Reporter(std::function<bool()> report) : report_(std::move(report)) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    if (summary.iteration == 0) return ceres::SOLVER_CONTINUE;
    return report_() ? ceres::SOLVER_CONTINUE : ceres::SOLVER_ABORT;
  }

 private:
  std::function<bool()> report_;
};

using InnerOptions = ceres::GradientProblemSolver::Options;

/// "" or why an option is refused.
std::string SetOptions(SolveMonitor& monitor, InnerOptions* inner, int* max_outer) {
  std::map<std::string, double*> numbers = {
      {"function_tolerance", &inner->function_tolerance},
      {"parameter_tolerance", &inner->parameter_tolerance},
      {"line_search_sufficient_function_decrease",
       &inner->line_search_sufficient_function_decrease},
      {"line_search_sufficient_curvature_decrease",
       &inner->line_search_sufficient_curvature_decrease},
  };
  std::map<std::string, int*> integers = {{"max_lbfgs_rank", &inner->max_lbfgs_rank},
                                          {"max_outer_iterations", max_outer}};
  std::vector<std::string> valid = {"line_search_direction_type"};
  for (const auto& [name, target] : numbers) valid.push_back(name);
  for (const auto& [name, target] : integers) valid.push_back(name);
  for (const auto& [name, text] : monitor.options().solver_options) {
    if (name == "line_search_direction_type") {
      if (!ceres::StringToLineSearchDirectionType(text, &inner->line_search_direction_type)) {
        return RefusedOption("ceres/auglag", name, text,
                             "valid are BFGS, LBFGS, NONLINEAR_CONJUGATE_GRADIENT");
      }
    } else if (numbers.count(name) > 0) {
      const std::optional<double> value = ParseNumber(text);
      if (!value) return RefusedOption("ceres/auglag", name, text, "a number is needed");
      *numbers[name] = *value;
    } else if (integers.count(name) > 0) {
      const std::optional<int> value = ParseInteger(text);
      if (!value || *value < 1) {
        return RefusedOption("ceres/auglag", name, text, "an integer ≥ 1 is needed");
      }
      *integers[name] = *value;
    } else {
      return UnknownOption("ceres/auglag", name, valid);
    }
  }
  if (std::string why; !inner->IsValid(&why)) return "ceres/auglag: " + why;
  monitor.Use("line_search_direction_type",
              ceres::LineSearchDirectionTypeToString(inner->line_search_direction_type));
  for (const auto& [name, target] : numbers) monitor.Use(name, TextOf(*target));
  for (const auto& [name, target] : integers) monitor.Use(name, std::to_string(*target));
  return "";
}

InnerOptions Defaults(const SolveMonitor& monitor) {
  constexpr int kDenseBfgs = 100;  // up to here an n×n matrix costs nothing
  InnerOptions inner;
  inner.logging_type = ceres::SILENT;
  inner.line_search_direction_type =
      monitor.problem().num_variables() <= kDenseBfgs ? ceres::BFGS : ceres::LBFGS;
  inner.use_approximate_eigenvalue_bfgs_scaling = true;
  inner.max_num_iterations = monitor.options().max_iterations;
  inner.function_tolerance = 1e-14;
  inner.parameter_tolerance = 1e-14;
  inner.update_state_every_iteration = true;
  return inner;
}

using Summary = ceres::GradientProblemSolver::Summary;

// Minimizes z → L(x(z)) from z on. The problem is made anew, since the function has changed.
Summary MinimizeInner(const InnerOptions& options, const AugmentedLagrangian& lagrangian,
                      const BoxTransform& box, Eigen::VectorXd* z) {
  const ceres::GradientProblem problem(
      std::make_unique<InnerFunction>(lagrangian, box, static_cast<int>(z->size())).release());
  Summary summary;
  ceres::Solve(options, problem, z->data(), &summary);
  return summary;
}

SolverEnd RunCeres(SolveMonitor& monitor, const Eigen::VectorXd& start) {
  monitor.EstimateAlgebra(kCeresPasses);
  constexpr double kOffTheBounds = 1e-3;  // of the width; a start on a bound would stay there
  constexpr int kMostFailures = 5;        // inner minimizations without any step, in a row
  const Problem& problem = monitor.problem();
  const double optimality = monitor.options().optimality_tolerance;
  const double feasibility = 0.5 * monitor.options().feasibility_tolerance;

  InnerOptions inner = Defaults(monitor);
  int max_outer = 60;
  if (std::string why = SetOptions(monitor, &inner, &max_outer); !why.empty()) {
    return {Ending::kInvalidInput, std::move(why), {}};
  }

  const QuietGlog quiet;
  const BoxTransform box(problem.lower(), problem.upper());
  AugmentedLagrangian lagrangian(&monitor);
  if (!lagrangian.Begin(start)) {
    return {Ending::kFailed, "A derivative at the start is not finite.", start};
  }
  Eigen::VectorXd x = start;
  Eigen::VectorXd z = box.FromBox(x);
  Reporter reporter([&] { return monitor.ReportIterate(box.ToBox(z)); });
  inner.callbacks.push_back(&reporter);

  int failures = 0;
  inner.gradient_tolerance = std::max(optimality, 1e-2);
  for (int outer = 0; outer < max_outer && monitor.MayGoOn(); ++outer) {
    double value = 0.0;
    Eigen::VectorXd gradient;
    if (!lagrangian.Evaluate(x, &value, &gradient)) break;
    z = box.FromBox(box.OffTheBounds(x, gradient, kOffTheBounds));
    const Summary summary = MinimizeInner(inner, lagrangian, box, &z);
    if (!monitor.MayGoOn()) break;
    x = box.ToBox(z);
    failures = summary.iterations.size() <= 1 && summary.termination_type == ceres::FAILURE
                   ? failures + 1
                   : 0;
    if (failures == kMostFailures) {
      return {Ending::kFailed, "Ceres: " + summary.message, x};
    }
    if (!lagrangian.Update(x)) break;
    const bool inner_done = summary.termination_type == ceres::CONVERGENCE;
    const double violation = problem.num_constraints() > 0 ? lagrangian.infeasibility() : 0.0;
    if (inner_done && inner.gradient_tolerance <= optimality && violation <= feasibility) {
      return {Ending::kConverged,
              "Augmented Lagrangian converged after " + std::to_string(outer + 1) +
                  " minimizations by Ceres.",
              x};
    }
    inner.gradient_tolerance = std::max(optimality, 0.1 * inner.gradient_tolerance);
  }
  if (!lagrangian.Update(x)) return {Ending::kFailed, "Ceres: a cost or row is not finite.", x};
  if (lagrangian.infeasibility() > std::sqrt(feasibility)) {
    return {Ending::kFailed, "The augmented Lagrangian stays infeasible.", x};
  }
  return {Ending::kLimit, "max_outer_iterations reached.", x};
}

class CeresSolver : public Solver {
 public:
  std::string name() const override { return "ceres/auglag"; }
  bool available() const override { return true; }
  std::string WhyUnavailable() const override { return ""; }
  std::string WhyUnsupported(const Problem&) const override { return ""; }
  Solution Solve(const Problem& problem, const Eigen::VectorXd& x0,
                 const SolverOptions& options) const override {
    return MonitoredSolve(*this, problem, x0, options, SolveMonitor::Iterations::kTold, RunCeres);
  }
};

}  // namespace

std::unique_ptr<Solver> MakeCeresSolver() { return std::make_unique<CeresSolver>(); }

}  // namespace halfstep::opt
