#include "planner/search/step_cost.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "wpg/check.h"
#include "wpg/nth.h"

namespace halfstep {

std::vector<double> StepCost::OfElements(const StepSet& set) const {
  std::vector<double> costs(set.placements.size(),
                            kind == CostKind::kSteps ? 1.0 : 2.0 * set.prototype.duration);
  for (int i = 0; kind == CostKind::kSmoothedDuration && i < set.size(); ++i) {
    double way = 0.0, turn = 0.0;
    for (const HalfStep& half_step : {set.Down(i, Side::kLeft), set.Up(i, Side::kLeft)}) {
      way += (half_step.X_SF.Planar().position() - half_step.via().position()).norm();
      turn += std::fabs(half_step.X_SF.yaw);
    }
    Nth(costs, i) = step_time + time_per_metre * way + time_per_radian * turn;
  }
  for (int i = 0; i < set.size(); ++i) {
    if (const auto [from, to] = set.ChangeOf(i); from != to) Nth(costs, i) *= kChangeOfHeight;
  }
  return costs;
}

StepReach::StepReach(const StepSet& set, const std::vector<int>& elements,
                     const std::vector<double>& costs)
    : least_cost_(std::numeric_limits<double>::infinity()) {
  HALFSTEP_CHECK(!elements.empty(), "no elements");
  std::vector<Eigen::Vector2d> seconds;
  for (int k : elements) {
    seconds.push_back(set.Placement(k, Side::kRight).Planar().position());
  }
  double pair2 = 0.0;  // its square
  for (int i : elements) {
    const Pose2 first = set.Placement(i, Side::kLeft).Planar();
    const Eigen::Matrix2d turned = first.rotation();
    one_ = std::max(one_, first.position().norm());
    turn_ = std::max(turn_, std::fabs(first.yaw));
    least_cost_ = std::min(least_cost_, Nth(costs, i));
    for (const Eigen::Vector2d& second : seconds) {
      pair2 = std::max(pair2, (first.position() + turned * second).squaredNorm());
    }
  }
  pair_ = std::sqrt(pair2);
}

double StepReach::Distance(int n) const { return (n / 2) * pair_ + (n % 2) * one_; }

// Distance(n) ≤ n·pair/2 + (one − pair/2) for every n, since one ≥ pair/2.
double StepReach::Steps(double distance, double turn) const {
  const double per_step = 0.5 * pair_;
  double steps = 0.0;
  if (distance > 0.0) {
    const double farther = distance - (one_ - per_step);
    steps = per_step > 0.0 ? std::max(0.0, farther / per_step)
                           : std::numeric_limits<double>::infinity();
  }
  if (turn > 0.0) {
    const double turns = turn_ > 0.0 ? turn / turn_ : std::numeric_limits<double>::infinity();
    steps = std::max(steps, turns);
  }
  return steps;
}

}  // namespace halfstep
