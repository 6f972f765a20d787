#include "opt/adapters/nlopt_solver.h"

#include <nlopt.h>

#include <cmath>
#include <memory>
#include <utility>

#include "opt/solvers/option_text.h"
#include "opt/solvers/solve_monitor.h"

namespace halfstep::opt {
namespace {

struct Destroy {
  void operator()(nlopt_opt opt) const { nlopt_destroy(opt); }
};
using Handle = std::unique_ptr<nlopt_opt_s, Destroy>;

/// One side of one row as NLopt wants it: sign·(g_row − bound) ≤ 0, or = 0.
struct Side {
  int row;
  double sign;
  double bound;
};

/// What the C callbacks get. Nothing may throw through the library: the monitor keeps exceptions.
struct Callback {
  SolveMonitor* monitor;
  nlopt_opt opt;
  std::vector<Side> sides;

  Eigen::VectorXd At(unsigned n, const double* x) const {
    return Eigen::Map<const Eigen::VectorXd>(x, static_cast<Eigen::Index>(n));
  }
};

/// A value that no finite one of the run exceeds: what has no finite value is refused by every
/// algorithm without its knowing of infinity, which makes some of them spin.
double Refusal(const SolveMonitor& monitor) {
  return monitor.highest_cost() + 10.0 * (1.0 + std::abs(monitor.highest_cost()));
}

double Objective(unsigned n, const double* x, double* gradient, void* data) {
  Callback& callback = *static_cast<Callback*>(data);
  const Eigen::VectorXd point = callback.At(n, x);
  double cost = 0.0;
  bool good = callback.monitor->Cost(point, &cost);
  if (gradient != nullptr) {
    Eigen::VectorXd value;
    if (good) good = callback.monitor->Gradient(point, &value);
    if (!good) value = Eigen::VectorXd::Zero(point.size());
    Eigen::Map<Eigen::VectorXd>(gradient, point.size()) = value;
  }
  // A method without constraints never asks for them; the point is complete nevertheless.
  if (callback.monitor->problem().num_constraints() == 0) {
    Eigen::VectorXd none;
    callback.monitor->Constraints(point, &none);
  }
  if (!callback.monitor->MayGoOn()) nlopt_force_stop(callback.opt);
  return good ? cost : Refusal(*callback.monitor);
}

void Rows(unsigned m, double* result, unsigned n, const double* x, double* gradient, void* data) {
  constexpr double kRefusedRow = 1e3;
  Callback& callback = *static_cast<Callback*>(data);
  const Eigen::VectorXd point = callback.At(n, x);
  Eigen::VectorXd values;
  std::vector<double> jacobian;
  bool good = callback.monitor->Constraints(point, &values);
  if (good && gradient != nullptr) good = callback.monitor->Jacobian(point, &jacobian);
  for (unsigned k = 0; k < m; ++k) {
    const Side& side = callback.sides[k];
    result[k] = good ? side.sign * (values[side.row] - side.bound) : kRefusedRow;
  }
  if (gradient != nullptr) {
    std::fill(gradient, gradient + static_cast<size_t>(m) * n, 0.0);
    if (good) {
      const SparsityPattern& pattern = callback.monitor->problem().pattern();
      std::vector<std::vector<unsigned>> sides_of(
          static_cast<size_t>(callback.monitor->problem().num_constraints()));
      for (unsigned k = 0; k < m; ++k) {
        sides_of[static_cast<size_t>(callback.sides[k].row)].push_back(k);
      }
      for (size_t e = 0; e < jacobian.size(); ++e) {
        for (const unsigned k : sides_of[static_cast<size_t>(pattern.rows[e])]) {
          gradient[static_cast<size_t>(k) * n + static_cast<size_t>(pattern.cols[e])] =
              callback.sides[k].sign * jacobian[e];
        }
      }
    }
  }
  if (!callback.monitor->MayGoOn()) nlopt_force_stop(callback.opt);
}

std::vector<Side> Sides(const Problem& problem, bool equalities) {
  std::vector<Side> sides;
  for (int i = 0; i < problem.num_constraints(); ++i) {
    const double lower = problem.constraint_lower()[i], upper = problem.constraint_upper()[i];
    if ((lower == upper) != equalities) continue;
    if (std::isfinite(upper)) sides.push_back({i, 1.0, upper});
    if (!equalities && std::isfinite(lower)) sides.push_back({i, -1.0, lower});
  }
  return sides;
}

/// Tolerances and what the user passes through, for the algorithm and, if any, its subsidiary.
class Settings {
 public:
  Settings(const NloptMethod& method, SolveMonitor* monitor) : method_(method), monitor_(monitor) {
    const double tolerance = monitor->options().optimality_tolerance;
    // Without derivatives a small change of cost says little about optimality.
    values_["ftol_rel"] = method.gradient ? 1e-3 * tolerance : 0.0;
    values_["ftol_abs"] = 0.0;
    values_["xtol_rel"] = method.finite_bounds ? 0.0 : 1e-2 * tolerance;
    values_["xtol_abs"] = 0.0;
    if (ccsa()) values_["dual_maxeval"] = 2000.0;  // NLopt's 100000 may take seconds per iteration
    values_["initial_step"] = 0.0;
    values_["population"] = 0.0;
    values_["vector_storage"] = 0.0;
  }

  /// "" or why an option is refused.
  std::string Read() {
    std::vector<std::string> valid;
    for (const auto& [name, value] : values_) valid.push_back(name);
    if (ccsa()) valid.insert(valid.end(), {"inner_maxeval", "dual_ftol_rel"});
    for (const auto& [name, text] : monitor_->options().solver_options) {
      if (std::find(valid.begin(), valid.end(), name) == valid.end()) {
        return UnknownOption(method_.name, name, valid);
      }
      const std::optional<double> value = ParseNumber(text);
      if (!value || *value < 0.0) {
        return RefusedOption(method_.name, name, text, "a number ≥ 0 is needed");
      }
      values_[name] = *value;
    }
    for (const auto& [name, value] : values_) monitor_->Use(name, TextOf(value));
    return "";
  }

  void Apply(nlopt_opt opt) const {
    for (const auto& [name, value] : values_) {
      if (name == "ftol_rel") {
        nlopt_set_ftol_rel(opt, value);
      } else if (name == "ftol_abs") {
        nlopt_set_ftol_abs(opt, value);
      } else if (name == "xtol_rel") {
        nlopt_set_xtol_rel(opt, value);
      } else if (name == "xtol_abs") {
        nlopt_set_xtol_abs1(opt, value);
      } else if (name == "initial_step") {
        if (value > 0.0) nlopt_set_initial_step1(opt, value);
      } else if (name == "population") {
        nlopt_set_population(opt, static_cast<unsigned>(value));
      } else if (name == "vector_storage") {
        nlopt_set_vector_storage(opt, static_cast<unsigned>(value));
      } else {
        nlopt_set_param(opt, name.c_str(), value);
      }
    }
    nlopt_set_maxeval(opt, monitor_->options().max_evaluations);
    if (std::isfinite(monitor_->options().deadline)) {
      nlopt_set_maxtime(opt, std::max(monitor_->RemainingTime(), 1e-6));
    }
  }

 private:
  bool ccsa() const {
    const std::string both = method_.algorithm + method_.subsidiary;
    return both.find("MMA") != std::string::npos || both.find("CCSAQ") != std::string::npos;
  }

  const NloptMethod& method_;
  SolveMonitor* monitor_;
  std::map<std::string, double> values_;
};

SolverEnd Translate(nlopt_result result, nlopt_opt opt, Eigen::VectorXd x) {
  const char* detail = nlopt_get_errmsg(opt);
  const std::string name = nlopt_result_to_string(result);
  const std::string message = "NLopt: " + name + (detail ? std::string(", ") + detail : "") + ".";
  switch (result) {
    case NLOPT_SUCCESS:
    case NLOPT_STOPVAL_REACHED:
    case NLOPT_FTOL_REACHED:
    case NLOPT_XTOL_REACHED:
      return {Ending::kConverged, message, std::move(x)};
    case NLOPT_ROUNDOFF_LIMITED:
      return {Ending::kFailed, message, std::move(x)};
    case NLOPT_MAXEVAL_REACHED:
      return {Ending::kLimit, message, std::move(x)};
    case NLOPT_MAXTIME_REACHED:
      return {Ending::kDeadline, message, std::move(x)};
    default:
      return {Ending::kFailed, message, std::move(x)};
  }
}

SolverEnd Run(const NloptMethod& method, SolveMonitor& monitor, const Eigen::VectorXd& start) {
  monitor.EstimateAlgebra(method.passes);
  const Problem& problem = monitor.problem();
  const auto n = static_cast<unsigned>(problem.num_variables());
  Settings settings(method, &monitor);
  if (std::string why = settings.Read(); !why.empty()) {
    return {Ending::kInvalidInput, std::move(why), {}};
  }

  const Handle opt(nlopt_create(nlopt_algorithm_from_string(method.algorithm.c_str()), n));
  nlopt_set_lower_bounds(opt.get(), problem.lower().data());
  nlopt_set_upper_bounds(opt.get(), problem.upper().data());
  Callback objective{&monitor, opt.get(), {}};
  Callback inequalities{&monitor, opt.get(), Sides(problem, false)};
  Callback equalities{&monitor, opt.get(), Sides(problem, true)};
  nlopt_set_min_objective(opt.get(), Objective, &objective);
  const auto add = [&](Callback& callback, auto function) {
    if (callback.sides.empty()) return;
    // Half of ours, so that what NLopt calls feasible is so for us.
    const std::vector<double> tolerance(callback.sides.size(),
                                        0.5 * monitor.options().feasibility_tolerance);
    function(opt.get(), static_cast<unsigned>(callback.sides.size()), Rows, &callback,
             tolerance.data());
  };
  add(inequalities, nlopt_add_inequality_mconstraint);
  add(equalities, nlopt_add_equality_mconstraint);
  if (!method.subsidiary.empty()) {
    const Handle local(nlopt_create(nlopt_algorithm_from_string(method.subsidiary.c_str()), n));
    settings.Apply(local.get());
    nlopt_set_local_optimizer(opt.get(), local.get());  // copies
  }
  settings.Apply(opt.get());
  nlopt_srand(monitor.options().seed);

  Eigen::VectorXd x = start;
  double cost = 0.0;
  const nlopt_result result = nlopt_optimize(opt.get(), x.data(), &cost);
  return Translate(result, opt.get(), std::move(x));
}

class NloptSolver : public Solver {
 public:
  explicit NloptSolver(NloptMethod method) : method_(std::move(method)) {}

  std::string name() const override { return method_.name; }
  bool available() const override { return true; }
  std::string WhyUnavailable() const override { return ""; }

  std::string WhyUnsupported(const Problem& problem) const override {
    const int equalities = problem.num_equalities();
    if (equalities > 0 && !method_.equalities) return name() + " takes no equality constraints.";
    if (problem.num_constraints() > equalities && !method_.inequalities) {
      return name() + " takes no constraints but bounds of variables.";
    }
    if (problem.num_variables() < method_.least_variables) {
      return name() + " needs at least " + std::to_string(method_.least_variables) + " variables.";
    }
    if (method_.finite_bounds && !(problem.lower().allFinite() && problem.upper().allFinite())) {
      return name() + " needs finite bounds on every variable.";
    }
    return "";
  }

  Solution Solve(const Problem& problem, const Eigen::VectorXd& x0,
                 const SolverOptions& options) const override {
    return MonitoredSolve(*this, problem, x0, options, SolveMonitor::Iterations::kImprovements,
                          [this](SolveMonitor& monitor, const Eigen::VectorXd& start) {
                            return Run(method_, monitor, start);
                          });
  }

 private:
  NloptMethod method_;
};

}  // namespace

std::unique_ptr<Solver> MakeNloptSolver(const NloptMethod& method) {
  return std::make_unique<NloptSolver>(method);
}

}  // namespace halfstep::opt
