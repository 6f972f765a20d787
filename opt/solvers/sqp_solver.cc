#include "opt/solvers/sqp_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "opt/problem/scaled_rows.h"
#include "opt/solvers/elastic_subproblem.h"
#include "opt/solvers/own_options.h"
#include "opt/solvers/row_penalties.h"
#include "opt/solvers/solve_monitor.h"

namespace halfstep::opt {
namespace {

using Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

constexpr double kAccept = 1e-4;              // of the predicted reduction
constexpr double kPoor = 0.25, kGood = 0.75;  // below it the region shrinks, above it grows
constexpr double kShrink = 0.3, kGrow = 1.5;
constexpr double kLeastRegion = 1e-12, kMostRegion = 1e3;  // of the variables' widths
constexpr double kFirstRegion = 0.02;                      // at least, of a later solve
// Of a group's violation: what a step may leave of it at any penalty, and what counts as none.
constexpr double kTolerated = 0.1, kNothing = 1e-9;
// How far the model's cost at a step may be from its minimum, of what the step saves: the merit
// function judges it, and where less can be saved, the step is the more exact.
constexpr double kGap = 0.03;

struct SqpMemory : WarmStart {
  explicit SqpMemory(size_t memory) : hessian(memory) {}

  VectorXd region;  // how far a step goes along each variable; empty: not known
  RowPenalties::Memory penalties;
  LimitedMemoryHessian hessian;
};

class Sqp {
 public:
  Sqp(SolveMonitor* monitor, const VectorXd& start, double radius, double first_penalty,
      double most_penalty, const SqpMemory& memory)
      : monitor_(*monitor),
        problem_(monitor->problem()),
        x_(start),
        first_penalty_(first_penalty),
        most_penalty_(most_penalty),
        known_(memory.penalties),
        hessian_(memory.hessian) {
    width_ = problem_.upper() - problem_.lower();
    for (int v = 0; v < x_.size(); ++v) {
      if (!std::isfinite(width_[v]) || Fixed(v)) width_[v] = std::max(1.0, std::abs(x_[v]));
    }
    region_ = radius * width_;
    if (memory.region.size() > 0) region_ = memory.region.cwiseMax(kFirstRegion * width_);
  }

  SolverEnd Run() {
    SolverEnd end = Iterate();
    auto memory = std::make_shared<SqpMemory>(0);
    memory->region = region_;
    if (penalties_) memory->penalties = penalties_->Remembered();
    memory->hessian = std::move(hessian_);
    end.warm_start = std::move(memory);
    return end;
  }

 private:
  SolverEnd Iterate() {
    std::vector<double> jacobian;
    if (!monitor_.Jacobian(x_, &jacobian) || !monitor_.Constraints(x_, &values_) ||
        !monitor_.Cost(x_, &cost_) || !monitor_.Gradient(x_, &gradient_)) {
      return Broken();
    }
    rows_.emplace(problem_, jacobian);
    penalties_.emplace(*rows_, known_, first_penalty_, most_penalty_);
    SparseMatrix A = rows_->Jacobian(jacobian);
    const SolverOptions& options = monitor_.options();
    while (monitor_.MayGoOn()) {
      if (moved_ && !Differentiate(&A)) return Broken();
      const VectorXd c = rows_->Values(values_);
      const ElasticStep step = Step(c, A);
      const double predicted = Predicted(step.d, c, A);
      const bool feasible =
          problem_.MaxViolation(x_, values_).amount <= options.feasibility_tolerance;
      if (feasible && Stationary(step.duals, A) <= options.optimality_tolerance) {
        return {Ending::kConverged, "SQP: first-order conditions hold.", x_};
      }
      const double size = std::max(1.0, std::abs(cost_) + penalties_->Owed(c));
      if ((region_.array() < kLeastRegion * width_.array()).all() || predicted <= 1e-14 * size) {
        // Exact or not, the penalty has a minimum here: violated rows have to cost more.
        if (!feasible && RaiseViolated(c)) continue;
        if (!feasible) {
          return {Ending::kFailed, "SQP: the violation has a local minimum.", x_};
        }
        return {Ending::kFailed, "SQP: no step improves any more.", x_};
      }
      if (!Try(step, c, predicted, &A)) return Broken();
    }
    return Broken();
  }

  SolverEnd Broken() const { return {Ending::kFailed, "SQP: broke off.", x_}; }

  bool Fixed(int v) const { return problem_.lower()[v] == problem_.upper()[v]; }

  // The step within the region.
  ElasticStep Restricted(const VectorXd& c, const SparseMatrix& A) const {
    ElasticSubproblem sub{.hessian = hessian_,
                          .g = gradient_,
                          .A = A,
                          .c = c,
                          .lower = {},
                          .upper = {},
                          .penalty = penalties_->OfRows(),
                          .gap = kGap};
    sub.lower = (problem_.lower() - x_).cwiseMax(-region_);
    sub.upper = (problem_.upper() - x_).cwiseMin(region_);
    for (int v = 0; v < x_.size(); ++v) {
      if (!Fixed(v)) continue;
      sub.g[v] = 0.0;
      sub.lower[v] = -region_[v];
      sub.upper[v] = region_[v];
    }
    ElasticStep step = Solve(sub);
    monitor_.CountAlgebra(step.linear_algebra);
    for (int v = 0; v < x_.size(); ++v) {
      if (Fixed(v)) step.d[v] = 0.0;
    }
    return step;
  }

  // A local minimum of the penalty function that is not feasible: violated rows cost more from now
  // on. False: they cost the most already.
  bool RaiseViolated(const VectorXd& c) {
    const std::vector<double> violations = penalties_->Violations(c);
    if (!penalties_->Raise(violations, std::vector<double>(violations.size(), 0.0))) return false;
    region_ = region_.cwiseMax(kFirstRegion * width_);
    return true;
  }

  // The step, at penalties that are high enough: where it leaves a group of rows violated in the
  // model although a higher penalty would halve that, the penalty is higher from now on.
  ElasticStep Step(const VectorXd& c, const SparseMatrix& A) {
    const ElasticStep step = Restricted(c, A);
    const std::vector<double> left = penalties_->Violations(c + A * step.d);
    std::vector<double> tolerated = penalties_->Violations(c), half = left;
    for (size_t k = 0; k < tolerated.size(); ++k) {
      tolerated[k] = std::max({kNothing, kTolerated * tolerated[k], step.gap / penalties_->Of(k)});
    }
    for (double& v : half) v *= 0.5;
    const RowPenalties before = *penalties_;
    if (!penalties_->Raise(left, tolerated)) return step;
    const ElasticStep dearer = Restricted(c, A);
    const std::vector<double> then = penalties_->Violations(c + A * dearer.d);
    return penalties_->TakeBack(before, then, half) ? Restricted(c, A) : dearer;
  }

  double Predicted(const VectorXd& d, const VectorXd& c, const SparseMatrix& A) const {
    return -gradient_.dot(d) - 0.5 * d.dot(hessian_.Times(d)) + penalties_->Owed(c) -
           penalties_->Owed(c + A * d);
  }

  // The largest entry of the Lagrangian's gradient that no bound's multiplier takes, and
  // complementarity.
  double Stationary(const VectorXd& duals, const SparseMatrix& A) const {
    VectorXd r = gradient_ - A.transpose() * duals;
    for (int v = 0; v < x_.size(); ++v) {
      if (x_[v] <= problem_.lower()[v]) r[v] = std::min(r[v], 0.0);
      if (x_[v] >= problem_.upper()[v]) r[v] = std::max(r[v], 0.0);
      if (Fixed(v)) r[v] = 0.0;
    }
    const double slack = duals.dot(rows_->Values(values_).cwiseMax(0.0));
    return std::max(r.lpNorm<Eigen::Infinity>(), slack) /
           std::max(1.0, gradient_.lpNorm<Eigen::Infinity>());
  }

  double Merit(double cost, const VectorXd& c) const { return cost + penalties_->Owed(c); }

  struct Trial {
    VectorXd x, values, c;
    double cost = 0.0, merit = std::numeric_limits<double>::infinity();
  };
  // Without derivatives: not every trial is taken, nor does every one that is have a successor.
  Trial At(const VectorXd& d) {
    Trial trial;
    trial.x = (x_ + d).cwiseMax(problem_.lower()).cwiseMin(problem_.upper());
    if (monitor_.Constraints(trial.x, &trial.values) && monitor_.Cost(trial.x, &trial.cost)) {
      trial.c = rows_->Values(trial.values);
      trial.merit = Merit(trial.cost, trial.c);
    }
    return trial;
  }

  // The region shrinks along the variables of rows that turned out worse than `expected`, the
  // violations in the model, and grows along those of other rows, if the step is taken.
  void Adapt(const VectorXd& d, const VectorXd& c, const VectorXd& expected, const Trial& trial,
             double ratio) {
    if (!std::isfinite(trial.merit)) {
      region_ *= kShrink;
      return;
    }
    const VectorXd before = (-c).cwiseMax(0.0), after = (-trial.c).cwiseMax(0.0);
    const std::vector<std::vector<int>>& variables = rows_->variables();
    std::vector<double> surprise(variables.size(), 0.0), gain(variables.size(), 1e-12);
    for (Eigen::Index i = 0; i < c.size(); ++i) {
      const size_t k = penalties_->GroupOf(i);
      surprise[k] += penalties_->Of(k) * std::max(0.0, after[i] - expected[i]);
      gain[k] += penalties_->Of(k) * std::max(0.0, before[i] - expected[i]);
    }
    VectorXd worst = VectorXd::Ones(x_.size());
    for (size_t k = 0; k < variables.size(); ++k) {
      for (int v : variables[k]) gain[k] += std::abs(gradient_[v] * d[v]);
      for (int v : variables[k]) worst[v] = std::min(worst[v], 1.0 - surprise[k] / gain[k]);
    }
    const bool all = ratio < kPoor && worst.minCoeff() >= kPoor;  // no row is to blame
    for (int v = 0; v < x_.size(); ++v) {
      const double moved = std::abs(d[v]);
      if (all || worst[v] < kPoor) {
        region_[v] = kShrink * std::clamp(moved, kShrink * region_[v], region_[v]);
      } else if (ratio > kAccept && worst[v] > kGood && moved > 0.9 * region_[v]) {
        region_[v] = std::min(kMostRegion * width_[v], kGrow * region_[v]);
      }
    }
  }

  // The derivatives after a step, and what the estimate of the Hessian learns from it. False: the
  // monitor ends.
  bool Differentiate(SparseMatrix* A) {
    std::vector<double> jacobian;
    if (!monitor_.Jacobian(x_, &jacobian) || !monitor_.Gradient(x_, &gradient_)) return false;
    *A = rows_->Jacobian(jacobian);
    hessian_.Update(moved_->by, gradient_ - A->transpose() * moved_->duals - moved_->slope);
    moved_.reset();
    return true;
  }

  // Goes there if the merit falls as predicted, and adapts the region. False: the monitor ends.
  bool Try(const ElasticStep& step, const VectorXd& c, double predicted,
           SparseMatrix* derivatives) {
    const SparseMatrix& A = *derivatives;
    const double merit = Merit(cost_, c);
    const double rounding = 1e-14 * std::max(1.0, std::abs(merit));
    Trial trial = At(step.d);
    if (!monitor_.MayGoOn()) return false;
    VectorXd d = step.d;
    double ratio = (merit - trial.merit + rounding) / (predicted + rounding);
    // Curved rows: the step is corrected by what they turned out to be.
    if (ratio < kPoor && trial.c.size() > 0 &&
        TotalViolation(trial.c) > TotalViolation(c + A * d)) {
      const ElasticStep corrected = Restricted(trial.c - A * d, A);
      Trial second = At(corrected.d);
      if (!monitor_.MayGoOn()) return false;
      if (second.merit < trial.merit) {
        trial = std::move(second);
        d = corrected.d;
        ratio = (merit - trial.merit + rounding) / (predicted + rounding);
      }
    }
    Adapt(d, c, (-c - A * step.d).cwiseMax(0.0), trial, ratio);
    if (!(ratio > kAccept)) return true;
    moved_ = {trial.x - x_, step.duals, gradient_ - A.transpose() * step.duals};
    x_ = trial.x;
    values_ = trial.values;
    cost_ = trial.cost;
    // What is learned of curvature is for a later solve, too.
    if (hessian_.remembers() && !Differentiate(derivatives)) return false;
    return monitor_.ReportIterate(x_);
  }

  // A step that was taken, until the derivatives at its end are known: the rows' duals and the
  // Lagrangian's gradient before it.
  struct Moved {
    VectorXd by, duals, slope;
  };

  SolveMonitor& monitor_;
  const Problem& problem_;
  VectorXd x_, width_, region_, values_, gradient_;
  double cost_ = 0.0;
  std::optional<Moved> moved_;      // none: the derivatives at x_ are known
  std::optional<ScaledRows> rows_;  // after the first evaluation
  double first_penalty_, most_penalty_;
  RowPenalties::Memory known_;             // from an earlier solve
  std::optional<RowPenalties> penalties_;  // after the first evaluation
  LimitedMemoryHessian hessian_;
};

class SqpSolver : public Solver {
 public:
  std::string name() const override { return "halfstep/sqp"; }
  // Where all is nearly linear, what curvature a few steps show of it does more harm than good; nor
  // does a small penalty jam at curved rows.
  SolverTraits traits() const override {
    return {
        .many_rows = true, .iterations = 3, .nearly_linear = {{"memory", "0"}, {"penalty", "2"}}};
  }
  bool available() const override { return true; }
  std::string WhyUnavailable() const override { return ""; }
  std::string WhyUnsupported(const Problem&) const override { return ""; }

  // `radius`: the first trust region, of the variables' widths; `memory`: steps that the Hessian's
  // estimate remembers; `penalty`, `most_penalty`: of a row's violation, first and at most.
  SolverEnd RunWithOptions(SolveMonitor& monitor, const VectorXd& start) const {
    std::vector<OwnOption> options = {{"radius", false, 0.1},
                                      {"memory", true, 12},
                                      {"penalty", false, 10.0},
                                      {"most_penalty", false, 1e8}};
    if (const auto refused = ReadOwnOptions(name(), &monitor, &options)) return *refused;
    SqpMemory memory(static_cast<size_t>(options[1].value));
    const auto* before = dynamic_cast<const SqpMemory*>(monitor.options().warm_start.get());
    if (before && before->region.size() == start.size()) memory = *before;
    return Sqp(&monitor, start, options[0].value, options[2].value, options[3].value, memory).Run();
  }

  Solution Solve(const Problem& problem, const VectorXd& x0,
                 const SolverOptions& options) const override {
    return MonitoredSolve(*this, problem, x0, options, SolveMonitor::Iterations::kTold,
                          [this](SolveMonitor& monitor, const VectorXd& start) {
                            return RunWithOptions(monitor, start);
                          });
  }
};

}  // namespace

std::unique_ptr<Solver> MakeSqpSolver() { return std::make_unique<SqpSolver>(); }

}  // namespace halfstep::opt
