#include "opt/solvers/solve_monitor.h"

#include <cmath>
#include <limits>
#include <utility>

#include "opt/problem/plain_stream.h"
#include "opt/problem/stationarity.h"

namespace halfstep::opt {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Below this a cost counts as unbounded (Ipopt's diverging_iterates_tol is of the same size).
constexpr double kUnboundedCost = -1e20;

}  // namespace

SolveMonitor::SolveMonitor(const Problem& problem, const SolverOptions& options,
                           Iterations iterations)
    : problem_(problem), options_(options), counting_(iterations), highest_cost_(-kInfinity) {}

double SolveMonitor::Wall() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

double SolveMonitor::RemainingTime() const { return options_.deadline - Wall(); }

void SolveMonitor::Stop(Ending ending, const std::string& message) {
  if (stopped_) return;  // the first reason stands
  stopped_ = ending;
  stop_message_ = message;
}

bool SolveMonitor::MayGoOn() {
  if (options_.stop.stop_requested()) {
    Stop(Ending::kInterrupted, "Stopped by request.");
  } else if (Wall() >= options_.deadline) {
    PlainStream told;
    told << "The deadline of " << options_.deadline << " s passed.";
    Stop(Ending::kDeadline, told.str());
  } else if (points_ > options_.max_evaluations) {
    Stop(Ending::kLimit,
         "max_evaluations = " + std::to_string(options_.max_evaluations) + " reached.");
  } else if (options_.may_go_on && !options_.may_go_on(counted_.linear_algebra)) {
    Stop(Ending::kLimit, "The effort of the solve is used.");
  }
  return !stopped_;
}

bool SolveMonitor::Guard(const std::function<void()>& evaluate) {
  if (stopped_ || (!beginning_ && !MayGoOn())) return false;
  try {
    evaluate();
    return true;
  } catch (const std::exception& error) {
    counted_.exception = std::current_exception();
    Stop(Ending::kFailed, std::string("A callback threw: ") + error.what());
  } catch (...) {
    counted_.exception = std::current_exception();
    Stop(Ending::kFailed, "A callback threw something that is no std::exception.");
  }
  return false;
}

void SolveMonitor::MoveTo(const Eigen::VectorXd& x) {
  if (point_.x.size() == x.size() && point_.x == x) return;
  point_ = Point{};
  point_.x = x;
  ++points_;
}

bool SolveMonitor::EvaluateCost() {
  if (!point_.cost) {
    double value = 0.0;
    if (!Guard([&] { value = problem_.Cost(point_.x); })) return false;
    ++counted_.cost_evaluations;
    point_.cost = value;
    if (!std::isfinite(value)) non_finite_ = "The cost is not finite.";
    Consider();
  }
  return std::isfinite(*point_.cost) && !stopped_;
}

bool SolveMonitor::EvaluateConstraints() {
  if (!point_.constraints) {
    if (!Guard([&] { KeepConstraints(problem_.Constraints(point_.x)); })) return false;
  }
  return point_.constraints->allFinite() && !stopped_;
}

void SolveMonitor::KeepConstraints(Eigen::VectorXd values) {
  if (values.size() > 0) ++counted_.constraint_evaluations;
  point_.violation = problem_.MaxViolation(point_.x, values);
  if (!values.allFinite()) {
    non_finite_ = "The value of " + point_.violation.row + " is not finite.";
  }
  point_.constraints = std::move(values);
  Consider();
}

bool SolveMonitor::Cost(const Eigen::VectorXd& x, double* cost) {
  MoveTo(x);
  if (!EvaluateCost()) return false;
  *cost = *point_.cost;
  return true;
}

bool SolveMonitor::Constraints(const Eigen::VectorXd& x, Eigen::VectorXd* values) {
  MoveTo(x);
  if (!EvaluateConstraints()) return false;
  *values = *point_.constraints;
  return true;
}

bool SolveMonitor::Gradient(const Eigen::VectorXd& x, Eigen::VectorXd* gradient) {
  MoveTo(x);
  if (!point_.gradient) {
    Eigen::VectorXd value;
    if (!Guard([&] { value = problem_.Gradient(point_.x); })) return false;
    ++counted_.gradient_evaluations;
    point_.gradient = std::move(value);
    if (!point_.gradient->allFinite()) non_finite_ = "The gradient of the cost is not finite.";
  }
  if (!point_.gradient->allFinite()) return false;
  *gradient = *point_.gradient;
  return true;
}

bool SolveMonitor::Jacobian(const Eigen::VectorXd& x, std::vector<double>* nonzeros) {
  MoveTo(x);
  if (!point_.jacobian) {
    std::vector<double> slopes;
    std::optional<Eigen::VectorXd> values;
    const bool evaluated = Guard([&] {
      if (point_.constraints) {
        slopes = problem_.Jacobian(point_.x);
      } else {
        values = problem_.ConstraintsWithJacobian(point_.x, &slopes);
      }
    });
    if (!evaluated) return false;
    ++counted_.jacobian_evaluations;
    CountAlgebra(static_cast<long>(passes_ * problem_.pattern().rows.size()));
    point_.jacobian = std::move(slopes);
    if (values) KeepConstraints(*std::move(values));
  }
  for (size_t k = 0; k < point_.jacobian->size(); ++k) {
    if (std::isfinite((*point_.jacobian)[k])) continue;
    non_finite_ =
        "The derivative of " + problem_.RowName(problem_.pattern().rows[k]) + " is not finite.";
    return false;
  }
  *nonzeros = *point_.jacobian;
  return true;
}

bool SolveMonitor::Better(const Point& a, const Point& b) const {
  if (!a.complete || !b.complete) return a.complete;
  const bool a_feasible = a.feasible(options_.feasibility_tolerance);
  const bool b_feasible = b.feasible(options_.feasibility_tolerance);
  if (a_feasible != b_feasible) return a_feasible;
  if (a_feasible || a.violation.amount == b.violation.amount) return *a.cost < *b.cost;
  return a.violation.amount < b.violation.amount;
}

void SolveMonitor::Consider() {
  if (!point_.cost || !point_.constraints) return;
  point_.complete = std::isfinite(*point_.cost) && point_.constraints->allFinite();
  if (!point_.complete) return;
  highest_cost_ = std::max(highest_cost_, *point_.cost);
  if (!Better(point_, best_)) return;
  best_ = point_;
  if (*best_.cost < kUnboundedCost && best_.feasible(options_.feasibility_tolerance)) {
    Stop(Ending::kFailed, "The cost is unbounded below: it fell under -1e20.");
  }
  if (counting_ == Iterations::kImprovements && !beginning_) CountIterate(best_);
}

void SolveMonitor::CountIterate(const Point& point) {
  const int iteration = counted_.history.empty() ? 0 : ++iterations_;
  counted_.history.push_back({iteration, *point.cost, point.violation.amount, Wall()});
  if (!options_.on_iterate) return;
  bool go_on = true;
  const Iterate iterate{iteration, point.x, *point.cost, point.violation.amount, Wall()};
  if (Guard([&] { go_on = options_.on_iterate(iterate); }) && !go_on) {
    Stop(Ending::kInterrupted,
         "on_iterate stopped at iteration " + std::to_string(iteration) + ".");
  }
}

bool SolveMonitor::ReportIterate(const Eigen::VectorXd& x) {
  MoveTo(x);
  if (EvaluateCost() && EvaluateConstraints()) {
    CountIterate(point_);
  } else {
    ++iterations_;
  }
  if (counting_ == Iterations::kTold && iterations_ > options_.max_iterations) {
    Stop(Ending::kLimit,
         "max_iterations = " + std::to_string(options_.max_iterations) + " reached.");
  }
  return MayGoOn();
}

bool SolveMonitor::Begin(const Eigen::VectorXd& start) {
  beginning_ = true;
  MoveTo(start);
  std::vector<double> slopes;
  if (counting_ == Iterations::kTold) Jacobian(start, &slopes);
  const bool evaluated = EvaluateCost() && EvaluateConstraints();
  if (evaluated) {
    CountIterate(point_);
  } else {
    Stop(Ending::kInvalidInput, "At the start: " + non_finite_);
  }
  beginning_ = false;
  return evaluated && MayGoOn();
}

Solution SolveMonitor::Finish(Ending claim, std::string message, const Eigen::VectorXd& final_x) {
  if (final_x.size() == problem_.num_variables() && final_x.allFinite()) {
    MoveTo(final_x);
    if (EvaluateCost()) EvaluateConstraints();
  }
  const Point end = point_;
  Solution solution = std::move(counted_);
  if (best_.complete) {
    solution.x = best_.x;
    solution.cost = *best_.cost;
    solution.max_violation = best_.violation.amount;
    solution.worst_row = best_.violation.row;
    solution.feasible = best_.feasible(options_.feasibility_tolerance);
  }
  solution.final_x = end.x;
  if (end.complete) {
    solution.final_cost = *end.cost;
    solution.final_violation = end.violation.amount;
  }
  Judge(claim, message, end, &solution);
  solution.iterations = iterations_;
  solution.requested_options = options_.solver_options;
  solution.used_options = used_;
  solution.wall = Wall();
  return solution;
}

bool SolveMonitor::EstimateStationarity(Solution* solution) {
  Eigen::VectorXd gradient;
  std::vector<double> jacobian;
  if (!Gradient(best_.x, &gradient) || !Jacobian(best_.x, &jacobian)) return false;
  Stationarity estimate =
      EstimateMultipliers(problem_, best_.x, gradient, *best_.constraints, jacobian);
  solution->stationarity = estimate.residual;
  solution->multipliers = std::move(estimate.multipliers);
  solution->bound_multipliers = std::move(estimate.bound_multipliers);
  return true;
}

void SolveMonitor::Judge(Ending claim, const std::string& message, const Point& end,
                         Solution* solution) {
  // Loose: solvers test scaled quantities, and a coarse test suffices to unmask false claims.
  const double stationary = std::max(1e-3, std::sqrt(options_.optimality_tolerance));
  const double nearly_stationary = 30.0 * stationary;
  const double tolerance = options_.feasibility_tolerance;
  solution->ending = claim;
  solution->message = message;
  const bool judged = claim == Ending::kConverged || claim == Ending::kFailed;
  const bool estimated =
      !stopped_ && judged && solution->feasible && EstimateStationarity(solution);
  if (stopped_) {
    solution->ending = *stopped_;
    solution->message = stop_message_;
    return;
  }
  if (!judged) return;
  PlainStream more;
  const bool success = claim == Ending::kConverged;
  if (success && !end.complete) {
    more << " But there: " << non_finite_;
  } else if (success && !end.feasible(tolerance)) {
    more << " But it ended at a point that violates " << end.violation.row << " by "
         << end.violation.amount << " " << end.violation.unit << ".";
  } else if (success && *end.cost - solution->cost > 1e-3 * std::max(1.0, std::abs(*end.cost))) {
    more << " But a cheaper feasible point had been seen.";
  } else if (success && estimated && solution->stationarity <= stationary) {
    return;
  }
  solution->ending = Ending::kFailed;
  if (!solution->feasible) {
    more << " Nothing feasible was seen.";
    if (!success && saw_non_finite()) more << " Not finite on the way: " << non_finite_;
  } else {
    const bool near = estimated && solution->stationarity <= nearly_stationary;
    if (near) solution->ending = Ending::kLimit;
    more << " The best feasible point seen "
         << (near ? "satisfies the first-order conditions nearly" : "is not stationary")
         << " (residual " << solution->stationarity << ").";
  }
  solution->message += more.str();
}

}  // namespace halfstep::opt
