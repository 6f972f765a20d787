#include "planner/search/footstep_astar.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "planner/search/timed_edges.h"

namespace halfstep {

PlanResult FootstepAStar::Plan(const PlanRequest& request, std::mt19937_64&) const {
  const std::vector<int> elements =
      elements_ == Elements::kAll ? AllElements(request.set) : ClassicSubset(request.set);
  return PlanWith(
      request, elements,
      [&](const std::vector<StepState>& starts, StepGraph* graph, PlanMonitor* monitor) {
        const auto to_go = [graph](const StepState& state) {
          return StepsToGo{.bound = static_cast<double>(graph->LeastSteps(state)),
                           .guess = graph->SteadySteps(state)};
        };
        std::optional<TimedEdges> in_time;
        if (request.times != nullptr) {
          in_time.emplace(*request.times, request.set.prototype.duration, graph);
        }
        StepSearch search(starts, to_go, options_, graph, monitor, in_time ? &*in_time : nullptr);
        return SearchEnd{.exhausted = search.Run()};
      });
}

std::vector<int> ClassicSubset(const StepSet& set) {
  if (set.size() == 0) return {};
  // As fractions of the largest |x|, of the least to the largest |y|, of the largest |yaw|.
  constexpr std::array<std::array<double, 3>, 14> kClassic = {{{1.0, 0.2, 0.0},
                                                               {0.7, 0.2, 0.0},
                                                               {0.4, 0.2, 0.0},
                                                               {0.0, 0.2, 0.0},
                                                               {-0.4, 0.2, 0.0},
                                                               {-0.7, 0.2, 0.0},
                                                               {0.0, 0.6, 0.0},
                                                               {0.0, 1.0, 0.0},
                                                               {0.4, 0.6, 0.0},
                                                               {-0.4, 0.6, 0.0},
                                                               {0.0, 0.5, 0.5},
                                                               {0.0, 0.5, 1.0},
                                                               {0.0, 0.5, -0.5},
                                                               {0.4, 0.4, -0.5}}};
  constexpr double kMetresPerRadian = 0.3;
  double x_max = 0.0, yaw_max = 0.0, y_max = 0.0, y_min = std::numeric_limits<double>::infinity();
  for (const Foothold& X_SF : set.placements) {
    x_max = std::max(x_max, std::fabs(X_SF.x));
    yaw_max = std::max(yaw_max, std::fabs(X_SF.yaw));
    y_max = std::max(y_max, std::fabs(X_SF.y));
    // Beside the support foot, where both feet can stand parallel.
    if (X_SF.x == 0.0 || std::fabs(X_SF.x) < 0.03) y_min = std::min(y_min, std::fabs(X_SF.y));
  }
  y_min = std::min(y_min, y_max);
  std::vector<int> subset;
  for (const auto& [ahead, aside, turned] : kClassic) {
    const Pose2 wanted{ahead * x_max, -(y_min + aside * (y_max - y_min)), -turned * yaw_max};
    const auto off = [&](const Foothold& X_SF) {
      return (X_SF.Planar().position() - wanted.position()).norm() +
             kMetresPerRadian * std::fabs(X_SF.yaw - wanted.yaw);
    };
    // For each difference of height, of levels or of the waist: elements of one are side by side.
    const auto index = [&](auto at) { return static_cast<int>(at - set.placements.begin()); };
    for (auto first = set.placements.begin(); first != set.placements.end();) {
      auto last = first;
      while (last != set.placements.end() && last->height == first->height &&
             set.ChangeOf(index(last)) == set.ChangeOf(index(first))) {
        ++last;
      }
      const auto nearest = std::min_element(
          first, last, [&off](const Foothold& x, const Foothold& y) { return off(x) < off(y); });
      subset.push_back(index(nearest));
      first = last;
    }
  }
  std::sort(subset.begin(), subset.end());
  subset.erase(std::unique(subset.begin(), subset.end()), subset.end());
  return subset;
}

}  // namespace halfstep
