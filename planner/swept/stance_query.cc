#include "planner/swept/stance_query.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "planner/swept/four_floats.h"
#include "wpg/check.h"
#include "wpg/elementary.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

// Sines of yaws, of which a set has a few.
class FewYaws {
 public:
  SineCosine Of(double yaw) {
    for (size_t i = 0; i < count_; ++i) {
      if (yaws_[i] == yaw) return values_[i];
    }
    const SineCosine value = SinCos(yaw);
    if (count_ < kMost) {
      yaws_[count_] = yaw;
      values_[count_++] = value;
    }
    return value;
  }

 private:
  static constexpr size_t kMost = 8;
  double yaws_[kMost];
  SineCosine values_[kMost];
  size_t count_ = 0;
};

}  // namespace

void StanceQuery::Reach::Add(const Bounds& bounds, double away) {
  if (bounds.empty) return;
  const Vector3d most = bounds.middle.cwiseAbs() + bounds.half;
  around = std::max(around, away + most.head<2>().norm());
  lowest = std::min(lowest, bounds.middle.z() - bounds.half.z());
  highest = std::max(highest, bounds.middle.z() + bounds.half.z());
}

StanceQuery::StanceQuery(const SweptVolumeQuery& query) : query_(query) {
  const std::vector<Foothold>& placements = query.volumes_.set.placements;
  for (size_t i = 0; i < placements.size(); ++i) {
    down_.Add(query.down_bounds_[i], 0.0);
    up_.Add(query.up_bounds_[i], placements[i].Planar().position().norm());
  }
}

// Places whose upright cylinders come near the box of the reach.
void StanceQuery::FindNear(const Foothold& X_WS, const Reach& reach) {
  near_.clear();
  const BoundsTree& tree = query_.tree_;
  if (tree.nodes.empty()) return;
  // Four times the slack of a single question, for these sums round otherwise.
  const double slack = 4e-6 * (1.0 + query_.farthest_ + std::abs(X_WS.x) + std::abs(X_WS.y) +
                               std::abs(X_WS.height) + reach.around);
  const double around = reach.around + slack;
  const double middle_z = X_WS.height + 0.5 * (reach.lowest + reach.highest);
  const double half_z = 0.5 * (reach.highest - reach.lowest) + slack;
  const auto four = [](double value) { return Four(static_cast<float>(value)); };
  const Four X = four(X_WS.x), Y = four(X_WS.y), Z = four(middle_z);
  int32_t stack[BoundsTree::kDeepest];
  int top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const int32_t n = stack[--top];
    const BoundsTree::Node& node = Nth(tree.nodes, n);
    const double x = std::abs(node.center.x() - X_WS.x) - node.half.x();
    const double y = std::abs(node.center.y() - X_WS.y) - node.half.y();
    if (std::max(x, y) > around || std::abs(node.center.z() - middle_z) > half_z + node.half.z()) {
      continue;
    }
    if (node.left >= 0) {
      stack[top++] = node.left + 1;
      stack[top++] = node.left;
      continue;
    }
    const size_t first = static_cast<size_t>(Nth(query_.leaf_begins_, n)) / 4;
    const size_t end = first + (static_cast<size_t>(node.count) + 3) / 4;
    for (size_t block = first; block < end; ++block) {
      const auto& o = query_.cylinders_[block];
      const Four reached = four(around) + Four::Load(o.radius);
      int near = (Four::Load(o.x) - X).Abs().Within(reached) &
                 (Four::Load(o.y) - Y).Abs().Within(reached) &
                 (Four::Load(o.z) - Z).Abs().Within(four(half_z) + Four::Load(o.half_height));
      for (; near != 0; near &= near - 1) {
        near_.push_back(static_cast<int32_t>(4 * block) +
                        std::countr_zero(static_cast<unsigned>(near)));
      }
    }
  }
}

// The sums of SweptVolumeQuery::MeetsLeaf, with half-steps side by side in place of obstacles.
void StanceQuery::Compare(size_t first) {
  float x[4] = {}, y[4] = {}, c[4] = {}, s[4] = {}, middle[3][4] = {}, half[3][4] = {};
  int asked = 0;
  for (size_t k = 0; k < 4 && first + k < placed_.size(); ++k) {
    if (!free_[first + k]) continue;
    asked |= 1 << k;
    const Placed& placed = placed_[first + k];
    const double sign = placed.mirrored ? -1.0 : 1.0;
    const double slack = query_.Slack(placed, 0.0);
    x[k] = static_cast<float>(placed.X_WS.x);
    y[k] = static_cast<float>(placed.X_WS.y);
    c[k] = static_cast<float>(placed.cos);
    s[k] = static_cast<float>(placed.sin);
    middle[0][k] = static_cast<float>(placed.bounds.middle.x());
    middle[1][k] = static_cast<float>(sign * placed.bounds.middle.y());
    middle[2][k] = static_cast<float>(placed.bounds.middle.z() + placed.X_WS.height);
    for (int axis = 0; axis < 3; ++axis) {
      half[axis][k] = static_cast<float>(placed.bounds.half[axis] + slack);
    }
  }
  const Four X = Four::Load(x), Y = Four::Load(y), C = Four::Load(c), S = Four::Load(s);
  const Four mx = Four::Load(middle[0]), my = Four::Load(middle[1]), mz = Four::Load(middle[2]);
  const Four hx = Four::Load(half[0]), hy = Four::Load(half[1]), hz = Four::Load(half[2]);
  for (size_t i = 0; i < near_.size(); ++i) {
    const auto& o = Nth(query_.cylinders_, near_[i] / 4);
    const int32_t of = near_[i] % 4;
    const Four along = Four(o.x[of]) - X, across = Four(o.y[of]) - Y, radius(o.radius[of]);
    int near = asked & (C * along + S * across - mx).Abs().Within(hx + radius) &
               (C * across - S * along - my).Abs().Within(hy + radius) &
               (Four(o.z[of]) - mz).Abs().Within(hz + Four(o.half_height[of]));
    for (; near != 0; near &= near - 1) {
      const size_t half_step =
          first + static_cast<size_t>(std::countr_zero(static_cast<unsigned>(near)));
      pairs_.push_back({static_cast<int32_t>(half_step), static_cast<int32_t>(i)});
    }
  }
}

void StanceQuery::Answer(const Foothold& X_WS, const Reach& reach, bool one_frame) {
  constexpr size_t kAhead = 8;  // pairs
  HALFSTEP_CHECK(X_WS.AllFinite(), "the sole's pose is not finite");
  free_.resize(placed_.size());
  for (size_t i = 0; i < placed_.size(); ++i) {
    const Placed& placed = placed_[i];
    free_[i] = placed.volume && placed.X_WS.height == *query_.level_;
  }
  FindNear(X_WS, reach);
  pairs_.clear();
  for (size_t i = 0; i < placed_.size(); i += 4) Compare(i);
  seen_.clear();
  if (one_frame && !placed_.empty()) {
    for (const int32_t slot : near_) {
      const auto& place = Nth(query_.places_, Nth(query_.place_at_, slot));
      seen_.push_back(SweptVolumeQuery::Seen(placed_[0], place));
    }
  }
  for (size_t i = 0; i < pairs_.size(); ++i) {
    if (i + kAhead < pairs_.size()) {
      const Placed& ahead = Nth(placed_, pairs_[i + kAhead].half_step);
      __builtin_prefetch(&ahead.bounds.root);
      __builtin_prefetch(&*ahead.volume);
    }
    const auto [half_step, near] = pairs_[i];
    if (!Nth(free_, half_step)) continue;
    const Placed& placed = Nth(placed_, half_step);
    const auto& place = Nth(query_.places_, Nth(query_.place_at_, Nth(near_, near)));
    const bool meets =
        one_frame
            ? query_.MeetsObstacle(*placed.volume, placed, place, Nth(seen_, near), place.extra)
            : query_.MeetsObstacle(*placed.volume, placed, place,
                                   SweptVolumeQuery::Seen(placed, place), place.extra);
    if (meets) Nth(free_, half_step) = false;
  }
}

const std::vector<bool>& StanceQuery::DownsAreFree(std::span<const int> elements, Side support,
                                                   const Foothold& X_WS) {
  const StepSet& set = query_.volumes_.set;
  if (!query_.level_) {
    free_.clear();
    for (const int i : elements) free_.push_back(query_.DownIsFree(i, support, X_WS));
    return free_;
  }
  const auto [s, c] = SinCos(X_WS.yaw);
  placed_.clear();
  for (const int i : elements) {
    placed_.push_back({Nth(query_.volumes_.down, i), Nth(query_.down_bounds_, i),
                       support == Side::kRight, X_WS, c, s});
  }
  Answer(X_WS, down_, /*one_frame=*/true);
  if (query_.areas_.empty()) return free_;
  for (size_t k = 0; k < elements.size(); ++k) {
    free_[k] =
        free_[k] && query_.areas_.Clears((X_WS * set.Placement(elements[k], support)).Planar(),
                                         query_.no_step_);
  }
  return free_;
}

const std::vector<bool>& StanceQuery::UpsAreFree(std::span<const int> elements, Side support,
                                                 const Foothold& X_WS) {
  const StepSet& set = query_.volumes_.set;
  if (!query_.level_) {
    free_.clear();
    for (const int i : elements) free_.push_back(query_.UpIsFree(i, support, X_WS));
    return free_;
  }
  FewYaws yaws;
  const auto [sin, cos] = SinCos(X_WS.yaw);
  placed_.clear();
  for (const int i : elements) {
    // The foot that has landed supports: X_WS · X_SF, to the bit.
    const Foothold X_SF = set.Placement(i, support);
    const Foothold X_WF({X_WS.x + cos * X_SF.x - sin * X_SF.y, X_WS.y + sin * X_SF.x + cos * X_SF.y,
                         X_WS.yaw + X_SF.yaw},
                        X_WS.height + X_SF.height);
    const auto [s, c] = yaws.Of(X_WF.yaw);
    placed_.push_back({Nth(query_.volumes_.up, i), Nth(query_.up_bounds_, i),
                       support == Side::kLeft, X_WF, c, s});
  }
  Answer(X_WS, up_, /*one_frame=*/false);
  return free_;
}

}  // namespace halfstep
