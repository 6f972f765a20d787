#pragma once

#include <Eigen/Core>
#include <limits>

#include "opt/solvers/solve_monitor.h"

namespace halfstep::opt {

/// The augmented Lagrangian of a Problem's rows l ≤ g(x) ≤ u, with the scaled cost F = s_f·f and
/// rows G_i = s_i·g_i, multipliers λ (m), penalty ρ and p_i = proj_[s_i l_i, s_i u_i](G_i + λ_i/ρ):
///
///     L(x) = F(x) + Σ_i [ ρ/2·(G_i + λ_i/ρ − p_i)² − λ_i²/(2ρ) ]
///     ∇L   = ∇F + Σ_i ρ·(G_i + λ_i/ρ − p_i)·∇G_i
///     λ_i ← ρ·(G_i + λ_i/ρ − p_i)
///
/// The scales are 1/max(1, largest |derivative| at the start). Bounds of variables are not in it.
/// Source: [Birgin2014], chapter 4; the two-sided form follows from their form with slacks.
class AugmentedLagrangian {
 public:
  /// `monitor` and its problem are borrowed.
  explicit AugmentedLagrangian(SolveMonitor* monitor) : monitor_(*monitor) {}

  /// Sets the scales, λ = 0 and ρ from the values at x. Returns false, as the others, when a value
  /// is not finite or the monitor stops.
  bool Begin(const Eigen::VectorXd& x);

  /// Evaluates L(x) and, unless `gradient` is null, ∇L (n).
  bool Evaluate(const Eigen::VectorXd& x, double* value, Eigen::VectorXd* gradient) const;

  /// Updates λ at x; ρ grows tenfold unless the infeasibility has halved.
  bool Update(const Eigen::VectorXd& x);

  /// Largest |G_i − proj(G_i + λ_i/ρ)| before the last Update: violation and missing
  /// complementarity.
  double infeasibility() const { return infeasibility_; }
  double penalty() const { return penalty_; }  ///< ρ

 private:
  Eigen::VectorXd Multipliers(const Eigen::VectorXd& g) const;  ///< the updated λ at values g (m)

  SolveMonitor& monitor_;
  double cost_scale_ = 1.0;
  Eigen::VectorXd row_scale_, lower_, upper_, multipliers_;
  double penalty_ = 10.0;
  double infeasibility_ = std::numeric_limits<double>::infinity();
};

}  // namespace halfstep::opt
