#include "planner/search/least_cost.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "wpg/nth.h"

namespace halfstep {

LeastCost::LeastCost(const StepSet& set, const StepGraph& graph) : graph_(graph) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<Pose2> first, second;
  for (int i : graph.elements()) {
    first.push_back(set.Placement(i, Side::kLeft).Planar());
    second.push_back(set.Placement(i, Side::kRight).Planar());
  }
  double per_metre = kInfinity, per_radian = kInfinity;
  for (int i = 0; i < graph.size(); ++i) {
    const Pose2& X_SF = Nth(first, i);
    const Eigen::Matrix2d turned = X_SF.rotation();
    if (X_SF.yaw != 0.0) per_radian = std::min(per_radian, graph.cost(i) / std::fabs(X_SF.yaw));
    for (int k = 0; k < graph.size(); ++k) {
      const double way = (X_SF.position() + turned * Nth(second, k).position()).norm();
      if (way > 0.0) per_metre = std::min(per_metre, (graph.cost(i) + graph.cost(k)) / way);
    }
  }
  per_radian_ = per_radian < kInfinity ? per_radian : 0.0;
  if (!(per_metre < kInfinity)) return;
  per_metre_ = per_metre;
  for (int i = 0; i < graph.size(); ++i) {
    extra_ = std::max(extra_, Nth(first, i).position().norm() - graph.cost(i) / per_metre);
  }
}

double LeastCost::From(const StepState& state) const {
  const GoalRegion& goal = graph_.goal();
  double way = goal.Distance(state.X_WS.Planar().position());
  // The middle of the feet is at most half an element from the foot before the last.
  if (goal.part == GoalPart::kMidFeet) way -= 0.5 * graph_.reach().one();
  // Of turns the middle of the feet makes a half less; what the last footstep turns is left out.
  const double turn = goal.part == GoalPart::kMidFeet ? 0.0 : goal.Turn(state.X_WS.yaw);
  return std::max({graph_.reach().least_cost() * graph_.LeastSteps(state),
                   per_metre_ * (way - extra_), per_radian_ * turn});
}

}  // namespace halfstep
