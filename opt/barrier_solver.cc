#include "opt/barrier_solver.h"

#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "opt/evaluation_session.h"
#include "opt/limited_memory_hessian.h"
#include "opt/own_options.h"

namespace halfstep::opt {
namespace {

using Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

constexpr double kInside = 1e-10;     // a slack below this (natural unit) counts as outside
constexpr double kPush = 1e-2;        // how far the start is pushed off its bounds, of their width
constexpr double kToBoundary = 0.01;  // of a slack that a step leaves at least
constexpr double kArmijo = 1e-4;
constexpr double kDualRange = 1e6;  // multipliers stay within this factor of μ/slack
constexpr double kReduction = 0.2;  // of μ, when its problem is nearly solved
constexpr int kBacktracks = 25;

// One inequality sign·(value − bound) ≥ 0 of a row, or of a variable.
struct Side {
  int index;
  double sign, bound;
  double Slack(const VectorXd& values) const { return sign * (values[index] - bound); }
};

std::vector<Side> SidesOf(const VectorXd& lower, const VectorXd& upper) {
  std::vector<Side> sides;
  for (int i = 0; i < lower.size(); ++i) {
    if (lower[i] == upper[i]) continue;  // a fixed variable
    if (std::isfinite(lower[i])) sides.push_back({i, 1.0, lower[i]});
    if (std::isfinite(upper[i])) sides.push_back({i, -1.0, upper[i]});
  }
  return sides;
}

class Barrier {
 public:
  Barrier(EvaluationSession* session, const VectorXd& start, double mu_init, size_t memory)
      : session_(*session),
        problem_(session->problem()),
        rows_(SidesOf(problem_.constraint_lower(), problem_.constraint_upper())),
        bounds_(SidesOf(problem_.lower(), problem_.upper())),
        x_(start),
        hessian_(memory),
        mu_(mu_init) {
    for (int v = 0; v < x_.size(); ++v) {
      const double lower = problem_.lower()[v], upper = problem_.upper()[v];
      const double width = std::isfinite(upper - lower) ? upper - lower : 1.0;
      if (lower == upper) continue;
      x_[v] = std::min(std::max(x_[v], lower + kPush * width), upper - kPush * width);
    }
  }

  Ending Run() {
    if (!EvaluateAt(x_)) return Broken();
    mu_ *= std::max(1.0, std::abs(cost_)) /
           static_cast<double>(std::max<size_t>(1, rows_.size() + bounds_.size()));
    row_duals_ = VectorXd::Ones(static_cast<Eigen::Index>(rows_.size()));
    bound_duals_ = VectorXd::Ones(static_cast<Eigen::Index>(bounds_.size()));
    ResetDuals();
    const double tolerance = session_.options().optimality_tolerance;
    int stalled = 0;
    while (true) {
      UpdatePhase();
      if (!outside_ && Error(0.0) <= tolerance) {
        return {SolveStatus::kConverged, "Barrier: first-order conditions hold.", x_};
      }
      if (Error(mu_) <= 10.0 * mu_ || decrement_ <= 0.3 * mu_ || stalled > 0) {
        decrement_ = std::numeric_limits<double>::infinity();
        const double least = 0.01 * tolerance;
        if (stalled > 0 && mu_ <= least) {
          return {outside_ ? SolveStatus::kInfeasible : SolveStatus::kAcceptable,
                  outside_ ? "Barrier: the violation has a local minimum."
                           : "Barrier: no step improves any more.",
                  x_};
        }
        mu_ = std::max(least, kReduction * mu_);
        ResetDuals();
      }
      const bool moved = Step();
      if (!session_.MayGoOn()) return Broken();
      stalled = moved ? 0 : stalled + 1;
      if (!moved) hessian_.Clear();
      if (stalled > 5) mu_ = 0.0;
      if (moved && !session_.ReportIterate(x_)) return Broken();
    }
  }

 private:
  Ending Broken() const { return {SolveStatus::kFailed, "Barrier: broke off.", x_}; }

  bool EvaluateAt(const VectorXd& x) {
    return session_.Constraints(x, &constraints_) && session_.Cost(x, &cost_) &&
           session_.Gradient(x, &gradient_) && EvaluateJacobian(x);
  }

  bool EvaluateJacobian(const VectorXd& x) {
    std::vector<double> nonzeros;
    if (!session_.Jacobian(x, &nonzeros)) return false;
    std::vector<Eigen::Triplet<double>> triplets;
    for (size_t k = 0; k < nonzeros.size(); ++k) {
      triplets.emplace_back(problem_.pattern().rows[k], problem_.pattern().cols[k], nonzeros[k]);
    }
    jacobian_.resize(problem_.num_constraints(), problem_.num_variables());
    jacobian_.setFromTriplets(triplets.begin(), triplets.end());
    return true;
  }

  // A row that is not strictly kept is lowered by the cost of the first phase instead of a barrier.
  bool IsOutside(const Side& row, const VectorXd& constraints) const {
    return row.Slack(constraints) < kInside;
  }

  void UpdatePhase() {
    const bool before = outside_;
    outside_ = std::any_of(rows_.begin(), rows_.end(),
                           [&](const Side& row) { return IsOutside(row, constraints_); });
    if (before != outside_) {
      hessian_.Clear();
      ResetDuals();
    }
  }

  void ResetDuals() {
    const auto reset = [this](const std::vector<Side>& sides, const VectorXd& values,
                              VectorXd* duals) {
      for (size_t i = 0; i < sides.size(); ++i) {
        const double central = mu_ / std::max(sides[i].Slack(values), kInside);
        double& dual = (*duals)[static_cast<Eigen::Index>(i)];
        dual = std::clamp(dual, central / kDualRange, central * kDualRange);
      }
    };
    reset(rows_, constraints_, &row_duals_);
    reset(bounds_, x_, &bound_duals_);
  }

  double DualScale() const { return std::max(1.0, gradient_.lpNorm<Eigen::Infinity>()); }

  // Weights w of Jᵀw for the rows: f's gradient is missing, duals of rows inside, and in the first
  // phase the violations.
  VectorXd RowWeights(const VectorXd& duals) const {
    VectorXd weights = VectorXd::Zero(problem_.num_constraints());
    for (size_t i = 0; i < rows_.size(); ++i) {
      const bool out = IsOutside(rows_[i], constraints_);
      weights[rows_[i].index] -= rows_[i].sign * (out ? 1.0 : duals[static_cast<Eigen::Index>(i)]);
    }
    return weights;
  }

  VectorXd CostGradient() const { return outside_ ? VectorXd::Zero(gradient_.size()) : gradient_; }

  // Gradient of the Lagrangian at the current point with given multipliers.
  VectorXd LagrangianGradient(const VectorXd& row_duals, const VectorXd& bound_duals) const {
    VectorXd result = CostGradient() + jacobian_.transpose() * RowWeights(row_duals);
    for (size_t i = 0; i < bounds_.size(); ++i) {
      result[bounds_[i].index] -= bounds_[i].sign * bound_duals[static_cast<Eigen::Index>(i)];
    }
    for (int v = 0; v < x_.size(); ++v) {
      if (problem_.lower()[v] == problem_.upper()[v]) result[v] = 0.0;
    }
    return result;
  }

  // Largest violation of the perturbed first-order conditions.
  double Error(double mu) const {
    double error = LagrangianGradient(row_duals_, bound_duals_).lpNorm<Eigen::Infinity>();
    const auto complementarity = [&](const std::vector<Side>& sides, const VectorXd& values,
                                     const VectorXd& duals, bool rows) {
      for (size_t i = 0; i < sides.size(); ++i) {
        if (rows && IsOutside(sides[i], values)) continue;
        error = std::max(
            error, std::abs(sides[i].Slack(values) * duals[static_cast<Eigen::Index>(i)] - mu));
      }
    };
    complementarity(rows_, constraints_, row_duals_, true);
    complementarity(bounds_, x_, bound_duals_, false);
    return error / DualScale();
  }

  // The merit function: cost, or the sum of violations, plus the barriers; inf outside.
  double Merit(double cost, const VectorXd& constraints, const VectorXd& x) const {
    double merit = outside_ ? 0.0 : cost;
    for (const Side& row : rows_) {
      const double slack = row.Slack(constraints);
      if (IsOutside(row, constraints_)) {
        merit += std::max(0.0, 2.0 * kInside - slack);
      } else if (slack > kInside) {
        merit -= mu_ * std::log(slack);
      } else {
        return std::numeric_limits<double>::infinity();
      }
    }
    for (const Side& bound : bounds_) {
      const double slack = bound.Slack(x);
      if (!(slack > 0.0)) return std::numeric_limits<double>::infinity();
      merit -= mu_ * std::log(slack);
    }
    return merit;
  }

  // −K⁻¹·g with K = σI + δI + Jᵀ(z/s)J + bounds − U·C⁻¹·Uᵀ; empty when it cannot be factorized.
  VectorXd Direction(const VectorXd& g, double damping) {
    VectorXd weights = VectorXd::Zero(problem_.num_constraints());
    for (size_t i = 0; i < rows_.size(); ++i) {
      if (IsOutside(rows_[i], constraints_)) continue;
      weights[rows_[i].index] +=
          row_duals_[static_cast<Eigen::Index>(i)] / rows_[i].Slack(constraints_);
    }
    VectorXd diagonal = VectorXd::Constant(x_.size(), hessian_.sigma() + damping);
    for (size_t i = 0; i < bounds_.size(); ++i) {
      diagonal[bounds_[i].index] +=
          bound_duals_[static_cast<Eigen::Index>(i)] / bounds_[i].Slack(x_);
    }
    SparseMatrix K = jacobian_.transpose() * weights.asDiagonal() * jacobian_;
    SparseMatrix identity(x_.size(), x_.size());
    identity.setIdentity();
    K += SparseMatrix(identity * diagonal.asDiagonal());
    const Eigen::SimplicialLDLT<SparseMatrix> factors(K);
    if (factors.info() != Eigen::Success) return {};
    VectorXd d = factors.solve(-g);
    if (!hessian_.empty()) {
      const Eigen::MatrixXd KU = factors.solve(hessian_.U());
      const Eigen::MatrixXd small = hessian_.C() - hessian_.U().transpose() * KU;
      d += KU * small.partialPivLu().solve(hessian_.U().transpose() * d);
    }
    return d;
  }

  // Largest α ≤ 1 at which linearized slacks keep a part of themselves.
  double StepLimit(const VectorXd& d, const VectorXd& Jd) const {
    double alpha = 1.0;
    const auto limit = [&alpha](const Side& side, const VectorXd& values, const VectorXd& change) {
      const double rate = side.sign * change[side.index];
      if (rate < 0.0) {
        alpha = std::min(alpha, (1.0 - kToBoundary) * side.Slack(values) / -rate);
      }
    };
    for (const Side& row : rows_) {
      if (!IsOutside(row, constraints_)) limit(row, constraints_, Jd);
    }
    for (const Side& bound : bounds_) limit(bound, x_, d);
    return alpha;
  }

  // One Newton step with line search, with more and more damping. False: none improves.
  bool Step() {
    VectorXd row_central(row_duals_.size()), bound_central(bound_duals_.size());
    for (size_t i = 0; i < rows_.size(); ++i) {
      row_central[static_cast<Eigen::Index>(i)] =
          mu_ / std::max(rows_[i].Slack(constraints_), kInside);
    }
    for (size_t i = 0; i < bounds_.size(); ++i) {
      bound_central[static_cast<Eigen::Index>(i)] = mu_ / bounds_[i].Slack(x_);
    }
    const VectorXd g = LagrangianGradient(row_central, bound_central);
    const double merit = Merit(cost_, constraints_, x_);
    for (int attempt = 0; attempt < 6; ++attempt) {
      const VectorXd d = Direction(g, damping_);
      if (d.size() > 0 && d.allFinite() && d.dot(g) < 0.0) {
        const VectorXd Jd = jacobian_ * d;
        double alpha = StepLimit(d, Jd);
        for (int k = 0; k < kBacktracks && alpha > 1e-10; ++k, alpha *= 0.5) {
          if (!session_.MayGoOn()) return false;
          const VectorXd x = x_ + alpha * d;
          VectorXd constraints;
          double cost = 0.0;
          if (!session_.Constraints(x, &constraints) || !session_.Cost(x, &cost)) continue;
          const double there = Merit(cost, constraints, x);
          if (!(there <= merit + kArmijo * alpha * d.dot(g))) continue;
          damping_ = alpha > 0.3 ? std::max(0.3 * damping_, 1e-12) : damping_;
          decrement_ = -d.dot(g);
          return MoveTo(x, alpha, d, Jd);
        }
      }
      damping_ = std::max(1e-4, 10.0 * damping_);
    }
    return false;
  }

  bool MoveTo(const VectorXd& x, double alpha, const VectorXd& d, const VectorXd& Jd) {
    const auto advance = [&](const std::vector<Side>& sides, const VectorXd& values,
                             const VectorXd& change, VectorXd* duals) {
      for (size_t i = 0; i < sides.size(); ++i) {
        const double slack = std::max(sides[i].Slack(values), kInside);
        double& dual = (*duals)[static_cast<Eigen::Index>(i)];
        const double step =
            mu_ / slack - dual - dual / slack * sides[i].sign * change[sides[i].index];
        dual = std::max(dual + alpha * step, 0.01 * dual);
      }
    };
    advance(rows_, constraints_, Jd, &row_duals_);
    advance(bounds_, x_, d, &bound_duals_);
    const VectorXd before = LagrangianGradient(row_duals_, bound_duals_);
    const bool phase_one = outside_;
    const VectorXd step = x - x_;
    if (!EvaluateAt(x)) return false;
    x_ = x;
    ResetDuals();
    UpdatePhase();
    if (!phase_one && !outside_) {
      hessian_.Update(step, LagrangianGradient(row_duals_, bound_duals_) - before);
    }
    return true;
  }

  EvaluationSession& session_;
  const Problem& problem_;
  std::vector<Side> rows_, bounds_;
  VectorXd x_, constraints_, gradient_;
  double cost_ = 0.0;
  SparseMatrix jacobian_;
  VectorXd row_duals_, bound_duals_;
  LimitedMemoryHessian hessian_;
  double mu_;  // first of the cost per inequality
  double damping_ = 1e-4;
  double decrement_ = std::numeric_limits<double>::infinity();  // −g·d of the last step
  bool outside_ = false;
};

class BarrierSolver : public Solver {
 public:
  std::string name() const override { return "halfstep/barrier"; }
  bool available() const override { return true; }
  std::string WhyUnavailable() const override { return ""; }
  std::string WhyUnsupported(const Problem& problem) const override {
    return problem.num_equalities() > 0
               ? "halfstep/barrier takes inequalities only; the problem has equalities"
               : "";
  }
  // `mu_init`: the first μ as a fraction of the cost per inequality; `memory`: steps that the
  // Hessian's estimate remembers.
  Ending RunWithOptions(EvaluationSession& session, const VectorXd& start) const {
    std::vector<OwnOption> options = {{"mu_init", false, 0.1}, {"memory", true, 12}};
    if (const auto refused = ReadOwnOptions(name(), &session, &options)) return *refused;
    return Barrier(&session, start, options[0].value, static_cast<size_t>(options[1].value)).Run();
  }

  Solution Solve(const Problem& problem, const Eigen::VectorXd& x0,
                 const SolverOptions& options) const override {
    return SolveInSession(*this, problem, x0, options, EvaluationSession::Iterations::kTold,
                          [this](EvaluationSession& session, const VectorXd& start) {
                            return RunWithOptions(session, start);
                          });
  }
};

}  // namespace

std::unique_ptr<Solver> MakeBarrierSolver() { return std::make_unique<BarrierSolver>(); }

}  // namespace halfstep::opt
