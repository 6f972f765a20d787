#include "opt/solvers/barrier_terms.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "wpg/elementary.h"

namespace halfstep::opt {
namespace {

using Eigen::VectorXd;

constexpr double kInside = 1e-10;         // a slack below this (natural unit) counts as outside
constexpr double kLeastSlackLeft = 0.01;  // of a slack that a step leaves at least
constexpr double kDualRange = 1e6;        // multipliers stay within this factor of μ/slack

}  // namespace

BarrierTerms::BarrierTerms(const VectorXd& lower, const VectorXd& upper, bool may_be_outside)
    : least_(may_be_outside ? kInside : 0.0) {
  for (int i = 0; i < lower.size(); ++i) {
    if (lower[i] == upper[i]) continue;
    if (std::isfinite(lower[i])) sides_.push_back({i, 1.0, lower[i]});
    if (std::isfinite(upper[i])) sides_.push_back({i, -1.0, upper[i]});
  }
  multipliers_ = VectorXd::Ones(static_cast<Eigen::Index>(sides_.size()));
}

bool BarrierTerms::AnyOutside(const VectorXd& values) const {
  return std::any_of(sides_.begin(), sides_.end(),
                     [&](const Side& side) { return IsOutside(side, values); });
}

VectorXd BarrierTerms::CentralMultipliers(const VectorXd& values, double mu) const {
  VectorXd central(multipliers_.size());
  for (Eigen::Index i = 0; i < central.size(); ++i) {
    central[i] = mu / std::max(SideAt(i).Slack(values), least_);
  }
  return central;
}

void BarrierTerms::ClampMultipliers(const VectorXd& values, double mu) {
  for (Eigen::Index i = 0; i < multipliers_.size(); ++i) {
    const double central = mu / std::max(SideAt(i).Slack(values), kInside);
    multipliers_[i] = std::clamp(multipliers_[i], central / kDualRange, central * kDualRange);
  }
}

void BarrierTerms::AdvanceMultipliers(const VectorXd& values, const VectorXd& change, double mu,
                                      double alpha) {
  for (Eigen::Index i = 0; i < multipliers_.size(); ++i) {
    const Side& side = SideAt(i);
    const double slack = std::max(side.Slack(values), kInside);
    double& z = multipliers_[i];
    const double step = mu / slack - z - z / slack * side.sign * change[side.index];
    z = std::max(z + alpha * step, 0.01 * z);
  }
}

void BarrierTerms::AddGradient(const VectorXd& values, const VectorXd& multipliers,
                               VectorXd* gradient) const {
  for (Eigen::Index i = 0; i < multipliers.size(); ++i) {
    const Side& side = SideAt(i);
    (*gradient)[side.index] -= side.sign * (IsOutside(side, values) ? 1.0 : multipliers[i]);
  }
}

void BarrierTerms::AddCurvature(const VectorXd& values, VectorXd* diagonal) const {
  for (Eigen::Index i = 0; i < multipliers_.size(); ++i) {
    const Side& side = SideAt(i);
    if (IsOutside(side, values)) continue;
    (*diagonal)[side.index] += multipliers_[i] / side.Slack(values);
  }
}

double BarrierTerms::ComplementarityError(const VectorXd& values, double mu) const {
  double error = 0.0;
  for (Eigen::Index i = 0; i < multipliers_.size(); ++i) {
    const Side& side = SideAt(i);
    if (IsOutside(side, values)) continue;
    error = std::max(error, std::abs(side.Slack(values) * multipliers_[i] - mu));
  }
  return error;
}

double BarrierTerms::StepLimit(const VectorXd& values, const VectorXd& change) const {
  double alpha = 1.0;
  for (const Side& side : sides_) {
    if (IsOutside(side, values)) continue;
    const double rate = side.sign * change[side.index];
    if (rate < 0.0) alpha = std::min(alpha, (1.0 - kLeastSlackLeft) * side.Slack(values) / -rate);
  }
  return alpha;
}

double BarrierTerms::AddedToMerit(double merit, const VectorXd& here, const VectorXd& there,
                                  double mu) const {
  for (const Side& side : sides_) {
    const double slack = side.Slack(there);
    if (IsOutside(side, here)) {
      merit += std::max(0.0, 2.0 * kInside - slack);
    } else if (slack > least_) {
      merit -= mu * Log(slack);
    } else {
      return std::numeric_limits<double>::infinity();
    }
  }
  return merit;
}

}  // namespace halfstep::opt
