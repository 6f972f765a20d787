#include "opt/solvers/augmented_lagrangian.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace halfstep::opt {
namespace {

constexpr double kLargestMultiplier = 1e12;  // keeps the penalty term from losing all digits
constexpr double kLargestPenalty = 1e10;

}  // namespace

bool AugmentedLagrangian::Begin(const Eigen::VectorXd& x) {
  const Problem& problem = monitor_.problem();
  double cost = 0.0;
  Eigen::VectorXd gradient, g;
  std::vector<double> jacobian;
  if (!monitor_.Cost(x, &cost) || !monitor_.Gradient(x, &gradient) ||
      !monitor_.Constraints(x, &g) || !monitor_.Jacobian(x, &jacobian)) {
    return false;
  }
  cost_scale_ = 1.0 / std::max(1.0, gradient.lpNorm<Eigen::Infinity>());
  Eigen::VectorXd steepest = Eigen::VectorXd::Ones(problem.num_constraints());
  for (size_t k = 0; k < jacobian.size(); ++k) {
    double& row = steepest[problem.pattern().rows[k]];
    row = std::max(row, std::abs(jacobian[k]));
  }
  row_scale_ = steepest.cwiseInverse();
  lower_ = problem.constraint_lower().cwiseProduct(row_scale_);
  upper_ = problem.constraint_upper().cwiseProduct(row_scale_);
  multipliers_ = Eigen::VectorXd::Zero(problem.num_constraints());
  const Eigen::VectorXd scaled = g.cwiseProduct(row_scale_);
  const double outside = (scaled - scaled.cwiseMax(lower_).cwiseMin(upper_)).squaredNorm();
  // As large as the cost beside the violation, within limits: the rule of [Birgin2014]'s ALGENCAN.
  penalty_ = std::clamp(
      10.0 * std::max(1.0, std::abs(cost_scale_ * cost)) / std::max(1.0, 0.5 * outside), 1e-1, 1e3);
  return true;
}

Eigen::VectorXd AugmentedLagrangian::Multipliers(const Eigen::VectorXd& g) const {
  const Eigen::VectorXd shifted = g.cwiseProduct(row_scale_) + multipliers_ / penalty_;
  return penalty_ * (shifted - shifted.cwiseMax(lower_).cwiseMin(upper_));
}

bool AugmentedLagrangian::Evaluate(const Eigen::VectorXd& x, double* value,
                                   Eigen::VectorXd* gradient) const {
  double cost = 0.0;
  Eigen::VectorXd g;
  if (!monitor_.Constraints(x, &g) || !monitor_.Cost(x, &cost)) return false;
  const Eigen::VectorXd updated = Multipliers(g);
  *value =
      cost_scale_ * cost + (updated.squaredNorm() - multipliers_.squaredNorm()) / (2.0 * penalty_);
  if (gradient == nullptr) return true;
  std::vector<double> jacobian;
  if (!monitor_.Gradient(x, gradient) || !monitor_.Jacobian(x, &jacobian)) return false;
  *gradient *= cost_scale_;
  const SparsityPattern& pattern = monitor_.problem().pattern();
  for (size_t k = 0; k < jacobian.size(); ++k) {
    const int row = pattern.rows[k];
    (*gradient)[pattern.cols[k]] += updated[row] * row_scale_[row] * jacobian[k];
  }
  return true;
}

bool AugmentedLagrangian::Update(const Eigen::VectorXd& x) {
  Eigen::VectorXd g;
  if (!monitor_.Constraints(x, &g)) return false;
  const Eigen::VectorXd updated = Multipliers(g);
  const double before = infeasibility_;
  infeasibility_ = g.size() == 0 ? 0.0
                                 : ((updated - multipliers_) / penalty_)
                                       .cwiseQuotient(row_scale_)
                                       .lpNorm<Eigen::Infinity>();
  multipliers_ = updated.cwiseMax(-kLargestMultiplier).cwiseMin(kLargestMultiplier);
  if (infeasibility_ > 0.5 * before) penalty_ = std::min(10.0 * penalty_, kLargestPenalty);
  return true;
}

}  // namespace halfstep::opt
