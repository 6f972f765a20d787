#include "planner/search/state_buckets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "wpg/check.h"
#include "wpg/nth.h"

namespace halfstep {

double StateDistance(const Pose2& a, const Pose2& b, bool with_yaw) {
  constexpr double kMetresPerRadian = 0.15;
  const double dx = a.x - b.x, dy = a.y - b.y;
  const double way = std::sqrt(dx * dx + dy * dy);
  if (!with_yaw) return way;
  double turn = a.yaw - b.yaw;
  if (std::fabs(turn) > std::numbers::pi) turn = std::remainder(turn, 2.0 * std::numbers::pi);
  return way + kMetresPerRadian * std::fabs(turn);
}

StateBuckets::StateBuckets(const Eigen::AlignedBox2d& area) : area_(area) {
  constexpr double kEdge = 0.25;
  constexpr double kMostAcross = 64.0;
  edge_ = std::max(kEdge, area.sizes().maxCoeff() / kMostAcross);
  count_ = (area.sizes() / edge_).array().ceil().max(1.0).matrix().cast<int>();
  for (auto& cells : cells_) cells.resize(static_cast<size_t>(count_.prod()));
}

Eigen::Vector2i StateBuckets::CellOf(const Pose2& X_W) const {
  const Eigen::Vector2d from_corner = (X_W.position() - area_.min()) / edge_;
  const Eigen::Vector2d most = (count_ - Eigen::Vector2i::Ones()).cast<double>();
  return from_corner.array().floor().max(0.0).min(most.array()).matrix().cast<int>();
}

std::vector<StateBuckets::Entry>& StateBuckets::At(const Eigen::Vector2i& cell, Side support) {
  return Nth(Nth(cells_, Index(support)), cell.y() * count_.x() + cell.x());
}

const std::vector<StateBuckets::Entry>& StateBuckets::At(const Eigen::Vector2i& cell,
                                                         Side support) const {
  return Nth(Nth(cells_, Index(support)), cell.y() * count_.x() + cell.x());
}

void StateBuckets::Insert(int index, const StepState& state) {
  At(CellOf(state.X_WS.Planar()), state.support).push_back({index, state.X_WS.Planar()});
  ++Nth(sizes_, Index(state.support));
}

void StateBuckets::Remove(int index, const StepState& state) {
  std::vector<Entry>& entries = At(CellOf(state.X_WS.Planar()), state.support);
  const auto entry = std::find_if(entries.begin(), entries.end(),
                                  [index](const Entry& e) { return e.index == index; });
  HALFSTEP_CHECK(entry != entries.end(), "index " << index);
  entries.erase(entry);
  --Nth(sizes_, Index(state.support));
}

// How far what is in a row of cells is from a coordinate at least [m]. Beyond the area cells have
// no end.
double StateBuckets::Gap(int cell, int axis, double at) const {
  constexpr double kRounding = 1e-9;  // [m]
  const double from = area_.min()[axis] + cell * edge_;
  const double below = cell > 0 ? from - at : 0.0;
  const double above = cell + 1 < count_[axis] ? at - (from + edge_) : 0.0;
  return std::max({below - kRounding, above - kRounding, 0.0});
}

int StateBuckets::FindNearest(const Pose2& X_W, Side support, bool with_yaw) const {
  if (size(support) == 0) return -1;
  const Eigen::Vector2i center = CellOf(X_W);
  int nearest = -1;
  double least = std::numeric_limits<double>::infinity();
  double least2 = least;  // squared, and a little more
  const auto visit = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= count_.x() || y >= count_.y()) return;
    const double across = Gap(x, 0, X_W.x), along = Gap(y, 1, X_W.y);
    if (across * across + along * along > least2) return;
    for (const Entry& entry : At({x, y}, support)) {
      const double dx = entry.X_WS.x - X_W.x, dy = entry.X_WS.y - X_W.y;
      if (dx * dx + dy * dy > least2) continue;
      const double distance = StateDistance(entry.X_WS, X_W, with_yaw);
      if (distance < least || (distance == least && entry.index < nearest)) {
        least = distance;
        least2 = least * least * (1.0 + 1e-9) + 1e-12;
        nearest = entry.index;
      }
    }
  };
  // Rings of cells: those of ring r are at least (r − 1) edges away.
  for (int ring = 0; ring < count_.maxCoeff() && (ring - 1) * edge_ <= least; ++ring) {
    for (int x = center.x() - ring; x <= center.x() + ring; ++x) {
      const bool side = std::abs(x - center.x()) == ring;
      for (int y = center.y() - ring; y <= center.y() + ring;
           y += side || ring == 0 ? 1 : 2 * ring) {
        visit(x, y);
      }
    }
  }
  return nearest;
}

}  // namespace halfstep
