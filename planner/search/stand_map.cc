#include "planner/search/stand_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>

#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr int kYaws = 8;

// The element of a height of the waist that lands nearest to beside the support sole; −1: none.
int BesideElement(const StepSet& set, const StepGraph& graph, int form) {
  constexpr double kMetresPerRadian = 0.3;
  int best = -1;
  double least = kFar;
  for (int k = 0; k < graph.size(); ++k) {
    const int i = Nth(graph.elements(), k);
    if (set.ChangeOf(i) != StepSet::Change{form, form}) continue;
    const Foothold& X_SF = Nth(set.placements, i);
    const double off = std::fabs(X_SF.x) + kMetresPerRadian * std::fabs(X_SF.yaw) +
                       0.1 * std::fabs(X_SF.y) + std::fabs(X_SF.height);
    if (off < least) {
      least = off;
      best = k;
    }
  }
  return best;
}

}  // namespace

StandMap::StandMap(const StepSet& set, const StepState& start, int places, StepGraph* graph) {
  const Eigen::AlignedBox2d& area = graph->workspace();
  const Eigen::Vector2d size = area.sizes();
  // A quarter of a footstep, or as fine as so many places can be.
  spacing_ = std::max(0.125 * graph->reach().Distance(2), std::sqrt(size.prod() / places));
  origin_ = area.min();
  for (int axis : {0, 1}) count_[axis] = 1 + static_cast<int>(size[axis] / spacing_);
  FindFree(set, start, graph);
  FindWays(*graph);
}

Eigen::Vector2d StandMap::PlaceOf(int cell) const {
  return origin_ + spacing_ * Eigen::Vector2d(cell % count_.x(), cell / count_.x());
}

void StandMap::FindFree(const StepSet& set, const StepState& start, StepGraph* graph) {
  const int cells = count_.prod();
  free_.assign(static_cast<size_t>(cells), false);
  for (int form = 0; form < set.num_forms(); ++form) AddFree(set, start, form, graph);
}

void StandMap::AddFree(const StepSet& set, const StepState& start, int form, StepGraph* graph) {
  const int k = BesideElement(set, *graph, form), cells = count_.prod();
  if (k < 0) return;
  const int i = Nth(graph->elements(), k);
  for (int cell = 0; cell < cells; ++cell) {
    const Eigen::Vector2d p_W = PlaceOf(cell);
    for (int yaw = 0; yaw < kYaws && !Nth(free_, cell); ++yaw) {
      const double turn = 2.0 * std::numbers::pi * yaw / kYaws;
      const Foothold X_WF({p_W.x(), p_W.y(), turn}, start.X_WS.height);
      for (Side support : {Side::kLeft, Side::kRight}) {
        const Foothold X_WS = X_WF * set.Placement(i, support).Inverse();
        const StepState from{X_WS, support, form};
        if (!graph->DownIsFree(from, k) || !graph->UpIsFree(from, k)) continue;
        free_[static_cast<size_t>(cell)] = true;
        break;
      }
    }
  }
}

// Dijkstra's search from the goal.
void StandMap::FindWays(const StepGraph& graph) {
  const double stride = 0.5 * graph.reach().Distance(2);
  const int most = static_cast<int>(stride / spacing_);
  using Waiting = std::pair<double, int>;
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> open;
  ways_.assign(free_.size(), kFar);
  const auto offer = [&](int cell, double way) {
    if (!Nth(free_, cell) || !(way < Nth(ways_, cell))) return;
    ways_[static_cast<size_t>(cell)] = way;
    open.push({way, cell});
  };
  for (int cell = 0; cell < static_cast<int>(free_.size()); ++cell) {
    const double left = graph.goal().Distance(PlaceOf(cell));
    if (left <= stride) offer(cell, left);
  }
  while (!open.empty()) {
    const auto [way, cell] = open.top();
    open.pop();
    if (way > Nth(ways_, cell)) continue;
    const int x = cell % count_.x(), y = cell / count_.x();
    for (int dx = -most; dx <= most; ++dx) {
      for (int dy = -most; dy <= most; ++dy) {
        const double step = spacing_ * std::sqrt(static_cast<double>(dx * dx + dy * dy));
        if (step > stride || x + dx < 0 || y + dy < 0 || x + dx >= count_.x() ||
            y + dy >= count_.y()) {
          continue;
        }
        offer((y + dy) * count_.x() + x + dx, way + step);
      }
    }
  }
}

double StandMap::Way(const Eigen::Vector2d& p_W) const {
  const Eigen::Vector2d p = (p_W - origin_) / spacing_;
  const int x0 = static_cast<int>(std::floor(p.x())), y0 = static_cast<int>(std::floor(p.y()));
  double least = kFar;
  for (int wider = 0; wider < 2 && least == kFar; ++wider) {
    for (int y = std::max(0, y0 - wider); y <= std::min(count_.y() - 1, y0 + 1 + wider); ++y) {
      for (int x = std::max(0, x0 - wider); x <= std::min(count_.x() - 1, x0 + 1 + wider); ++x) {
        const double way = Nth(ways_, y * count_.x() + x);
        if (way < least)
          least = std::min(least, way + spacing_ * (Eigen::Vector2d(x, y) - p).norm());
      }
    }
  }
  return least;
}

}  // namespace halfstep
