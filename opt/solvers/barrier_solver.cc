#include "opt/solvers/barrier_solver.h"

#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "opt/solvers/barrier_terms.h"
#include "opt/solvers/limited_memory_hessian.h"
#include "opt/solvers/own_options.h"
#include "opt/solvers/solve_monitor.h"

namespace halfstep::opt {
namespace {

using Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

// Multiplications of a factorization with this factor, or of AᵀA for Aᵀ, about.
long SquaredColumns(const SparseMatrix& matrix) {
  long sum = 0;
  for (Eigen::Index k = 0; k < matrix.outerSize(); ++k) {
    const long entries = matrix.col(k).nonZeros();
    sum += entries * entries;
  }
  return sum;
}

constexpr double kPush = 1e-2;  // how far the start is pushed off its bounds, of their width
constexpr double kArmijo = 1e-4;
constexpr double kReduction = 0.2;  // of μ, when its problem is nearly solved
constexpr int kBacktracks = 25;

class Barrier {
 public:
  Barrier(SolveMonitor* monitor, const VectorXd& start, double mu_init, size_t memory)
      : monitor_(*monitor),
        problem_(monitor->problem()),
        rows_(problem_.constraint_lower(), problem_.constraint_upper(), /*may_be_outside=*/true),
        bounds_(problem_.lower(), problem_.upper(), /*may_be_outside=*/false),
        x_(start),
        hessian_(memory),
        mu_(mu_init) {
    for (int v = 0; v < x_.size(); ++v) {
      const double lower = problem_.lower()[v], upper = problem_.upper()[v];
      const double width = std::isfinite(upper - lower) ? upper - lower : 1.0;
      if (Fixed(v)) continue;
      x_[v] = std::min(std::max(x_[v], lower + kPush * width), upper - kPush * width);
    }
  }

  SolverEnd Run() {
    if (!EvaluateAt(x_)) return Broken();
    mu_ *= std::max(1.0, std::abs(cost_)) /
           static_cast<double>(std::max<size_t>(1, rows_.size() + bounds_.size()));
    ClampMultipliers();
    const double tolerance = monitor_.options().optimality_tolerance;
    int stalled = 0;
    while (true) {
      UpdatePhase();
      if (!outside_ && Error(0.0) <= tolerance) {
        return {Ending::kConverged, "Barrier: first-order conditions hold.", x_};
      }
      if (Error(mu_) <= 10.0 * mu_ || decrement_ <= 0.3 * mu_ || stalled > 0) {
        decrement_ = std::numeric_limits<double>::infinity();
        const double least = 0.01 * tolerance;
        if (stalled > 0 && mu_ <= least) {
          return {Ending::kFailed,
                  outside_ ? "Barrier: the violation has a local minimum."
                           : "Barrier: no step improves any more.",
                  x_};
        }
        mu_ = std::max(least, kReduction * mu_);
        ClampMultipliers();
      }
      const bool moved = Step();
      if (!monitor_.MayGoOn()) return Broken();
      stalled = moved ? 0 : stalled + 1;
      if (!moved) hessian_.Clear();
      if (stalled > 5) mu_ = 0.0;
      if (moved && !monitor_.ReportIterate(x_)) return Broken();
    }
  }

 private:
  SolverEnd Broken() const { return {Ending::kFailed, "Barrier: broke off.", x_}; }

  bool Fixed(int v) const { return problem_.lower()[v] == problem_.upper()[v]; }

  bool EvaluateAt(const VectorXd& x) {
    return monitor_.Constraints(x, &constraints_) && monitor_.Cost(x, &cost_) &&
           monitor_.Gradient(x, &gradient_) && EvaluateJacobian(x);
  }

  bool EvaluateJacobian(const VectorXd& x) {
    std::vector<double> nonzeros;
    if (!monitor_.Jacobian(x, &nonzeros)) return false;
    std::vector<Eigen::Triplet<double>> triplets;
    for (size_t k = 0; k < nonzeros.size(); ++k) {
      if (Fixed(problem_.pattern().cols[k])) continue;  // Newton's steps leave it where it is
      triplets.emplace_back(problem_.pattern().rows[k], problem_.pattern().cols[k], nonzeros[k]);
    }
    jacobian_.resize(problem_.num_constraints(), problem_.num_variables());
    jacobian_.setFromTriplets(triplets.begin(), triplets.end());
    return true;
  }

  // A row that is not strictly kept is lowered by the cost of the first phase instead of a barrier.
  void UpdatePhase() {
    const bool before = outside_;
    outside_ = rows_.AnyOutside(constraints_);
    if (before != outside_) {
      hessian_.Clear();
      ClampMultipliers();
    }
  }

  void ClampMultipliers() {
    rows_.ClampMultipliers(constraints_, mu_);
    bounds_.ClampMultipliers(x_, mu_);
  }

  double DualScale() const { return std::max(1.0, gradient_.lpNorm<Eigen::Infinity>()); }

  VectorXd CostGradient() const { return outside_ ? VectorXd::Zero(gradient_.size()) : gradient_; }

  // Gradient of the Lagrangian at the current point with given multipliers. In the first phase the
  // violations stand for f.
  VectorXd LagrangianGradient(const VectorXd& of_rows, const VectorXd& of_bounds) const {
    VectorXd weights = VectorXd::Zero(problem_.num_constraints());
    rows_.AddGradient(constraints_, of_rows, &weights);
    VectorXd result = CostGradient() + jacobian_.transpose() * weights;
    bounds_.AddGradient(x_, of_bounds, &result);
    for (int v = 0; v < x_.size(); ++v) {
      if (Fixed(v)) result[v] = 0.0;
    }
    return result;
  }

  VectorXd LagrangianGradient() const {
    return LagrangianGradient(rows_.multipliers(), bounds_.multipliers());
  }

  // Largest violation of the perturbed first-order conditions.
  double Error(double mu) const {
    const double error = std::max({LagrangianGradient().lpNorm<Eigen::Infinity>(),
                                   rows_.ComplementarityError(constraints_, mu),
                                   bounds_.ComplementarityError(x_, mu)});
    return error / DualScale();
  }

  // The merit function: cost, or the sum of violations, plus the barriers; inf outside.
  double Merit(double cost, const VectorXd& constraints, const VectorXd& x) const {
    const double merit = rows_.AddedToMerit(outside_ ? 0.0 : cost, constraints_, constraints, mu_);
    return bounds_.AddedToMerit(merit, x_, x, mu_);
  }

  // −K⁻¹·g with K = σI + δI + Jᵀ(z/s)J + bounds − U·C⁻¹·Uᵀ; empty when it cannot be factorized.
  VectorXd Direction(const VectorXd& g, double damping) {
    VectorXd weights = VectorXd::Zero(problem_.num_constraints());
    rows_.AddCurvature(constraints_, &weights);
    VectorXd diagonal = VectorXd::Constant(x_.size(), hessian_.sigma() + damping);
    bounds_.AddCurvature(x_, &diagonal);
    SparseMatrix K = jacobian_.transpose() * weights.asDiagonal() * jacobian_;
    SparseMatrix identity(x_.size(), x_.size());
    identity.setIdentity();
    K += SparseMatrix(identity * diagonal.asDiagonal());
    const Eigen::SimplicialLDLT<SparseMatrix> factors(K);
    const SparseMatrix& factor = factors.matrixL().nestedExpression();
    monitor_.CountAlgebra(SquaredColumns(factor) + SquaredColumns(jacobian_.transpose()));
    if (factors.info() != Eigen::Success) return {};
    VectorXd d = factors.solve(-g);
    if (!hessian_.empty()) {
      const Eigen::MatrixXd KU = factors.solve(hessian_.U());
      const Eigen::MatrixXd small = hessian_.C() - hessian_.U().transpose() * KU;
      d += KU * small.partialPivLu().solve(hessian_.U().transpose() * d);
    }
    return d;
  }

  // One Newton step with line search, with more and more damping. False: none improves.
  bool Step() {
    const VectorXd g = LagrangianGradient(rows_.CentralMultipliers(constraints_, mu_),
                                          bounds_.CentralMultipliers(x_, mu_));
    const double merit = Merit(cost_, constraints_, x_);
    for (int attempt = 0; attempt < 6; ++attempt) {
      const VectorXd d = Direction(g, damping_);
      if (d.size() > 0 && d.allFinite() && d.dot(g) < 0.0) {
        const VectorXd Jd = jacobian_ * d;
        double alpha = std::min(rows_.StepLimit(constraints_, Jd), bounds_.StepLimit(x_, d));
        for (int k = 0; k < kBacktracks && alpha > 1e-10; ++k, alpha *= 0.5) {
          if (!monitor_.MayGoOn()) return false;
          const VectorXd x = x_ + alpha * d;
          VectorXd constraints;
          double cost = 0.0;
          if (!monitor_.Constraints(x, &constraints) || !monitor_.Cost(x, &cost)) continue;
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
    rows_.AdvanceMultipliers(constraints_, Jd, mu_, alpha);
    bounds_.AdvanceMultipliers(x_, d, mu_, alpha);
    const VectorXd before = LagrangianGradient();
    const bool phase_one = outside_;
    const VectorXd step = x - x_;
    if (!EvaluateAt(x)) return false;
    x_ = x;
    ClampMultipliers();
    UpdatePhase();
    if (!phase_one && !outside_) {
      hessian_.Update(step, LagrangianGradient() - before);
    }
    return true;
  }

  SolveMonitor& monitor_;
  const Problem& problem_;
  BarrierTerms rows_, bounds_;
  VectorXd x_, constraints_, gradient_;
  double cost_ = 0.0;
  SparseMatrix jacobian_;
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
  SolverEnd RunWithOptions(SolveMonitor& monitor, const VectorXd& start) const {
    std::vector<OwnOption> options = {{"mu_init", false, 0.1}, {"memory", true, 12}};
    if (const auto refused = ReadOwnOptions(name(), &monitor, &options)) return *refused;
    return Barrier(&monitor, start, options[0].value, static_cast<size_t>(options[1].value)).Run();
  }

  Solution Solve(const Problem& problem, const Eigen::VectorXd& x0,
                 const SolverOptions& options) const override {
    return MonitoredSolve(*this, problem, x0, options, SolveMonitor::Iterations::kTold,
                          [this](SolveMonitor& monitor, const VectorXd& start) {
                            return RunWithOptions(monitor, start);
                          });
  }
};

}  // namespace

std::unique_ptr<Solver> MakeBarrierSolver() { return std::make_unique<BarrierSolver>(); }

}  // namespace halfstep::opt
