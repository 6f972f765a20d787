#include "planner/swept/swept_volume_query.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "planner/scene/solid_body.h"
#include "planner/swept/four_floats.h"
#include "planner/swept/swept_volume_bake.h"
#include "wpg/check.h"
#include "wpg/elementary.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Tops this little above a sole are at it: the same level by another sum [m].
constexpr double kSameLevel = 1e-8;

// From W into the frame of a sole with this cosine and sine of its yaw, and there into the mirror.
Matrix3d RotationInto(double c, double s, bool mirrored) {
  const double sign = mirrored ? -1.0 : 1.0;
  Matrix3d R;
  R << c, s, 0, -sign * s, sign * c, 0, 0, 0, 1;
  return R;
}

}  // namespace

SweptVolumeQuery::SweptVolumeQuery(const SweptVolumes& volumes,
                                   const Eigen::Matrix2Xd& sole_outline, const Scene& scene,
                                   double no_step, double until, double foothold)
    : volumes_(volumes),
      down_bounds_(BoundsOf(volumes.down)),
      up_bounds_(BoundsOf(volumes.up)),
      down_swing_bounds_(BoundsOf(volumes.down_swing)),
      up_swing_bounds_(BoundsOf(volumes.up_swing)),
      down_stand_bounds_(BoundsOf(volumes.down_stand)),
      up_stand_bounds_(BoundsOf(volumes.up_stand)),
      ground_(scene.ground),
      levels_(*scene.ground),
      sole_outline_(sole_outline),
      foothold_(foothold),
      no_step_(no_step),
      areas_(scene, sole_outline) {
  const size_t size = volumes.set.placements.size();
  ForEachVolume(volumes, volumes.set.on_levels, [size](const SweptVolumes::Volumes& all) {
    HALFSTEP_CHECK(all.size() == size, all.size() << " volumes of " << size);
  });
  if (!volumes.set.on_levels) {
    HALFSTEP_CHECK(ground_->Solids().empty(), ground_->Solids().size() << " solids");
    level_ = ground_->HeightEverywhere();
    for (const Foothold& X_SF : volumes.set.placements) X_SF.CheckLevel();
  }
  CheckPlaces(scene, until);
  std::vector<ObstaclePlace> all;
  const size_t least = scene.obstacles.size() + ground_->Solids().size();
  all.reserve(least);
  places_.reserve(least);
  only_places_.reserve(scene.obstacles.size());
  for (const Obstacle& obstacle : scene.obstacles) {
    only_places_.push_back(obstacle.motion.waypoints.empty() ? static_cast<int>(all.size()) : -1);
    Prepared prepared = Prepare(obstacle);
    const std::vector<ObstaclePlace> its = PlacesOf(obstacle, until);
    for (size_t i = 0; i < its.size(); ++i) {
      all.push_back(its[i]);
      if (i + 1 < its.size()) {
        places_.push_back(prepared);
      } else {
        places_.push_back(std::move(prepared));
      }
      places_.back().extra += its[i].extra;
    }
  }
  for (const GroundSolid& solid : ground_->Solids()) {
    const Obstacle body = BodyOf(solid);
    all.push_back({.X_WO = body.X_WO});
    places_.push_back(Prepare(body));
    places_.back().top = solid.top;
  }
  std::vector<Upright> cylinders;
  cylinders.reserve(all.size());
  for (int i = 0; i < std::ssize(all); ++i) cylinders.push_back(Move(i, Nth(all, i).X_WO));
  PlantTree(cylinders);
}

OrientedBox SweptVolumeQuery::Seen(const Placed& placed, const Prepared& obstacle) {
  const Matrix3d R = RotationInto(placed.cos, placed.sin, placed.mirrored);
  const Vector3d p_WS(placed.X_WS.x, placed.X_WS.y, placed.X_WS.height);
  return {.center = R * (obstacle.around_W.center - p_WS),
          .half = obstacle.around_W.half,
          .axes = R * obstacle.around_W.axes};
}

bool SweptVolumeQuery::MeetsObstacle(const BoxTree& tree, const Placed& placed,
                                     const Prepared& obstacle, const OrientedBox& around,
                                     double extra) const {
  const BoxNode* root = &placed.bounds.root;
  if (std::holds_alternative<std::monostate>(obstacle.shape)) {
    return Meets(tree, around, extra, root);
  }
  if (const auto* round = std::get_if<RoundBody>(&obstacle.shape)) {
    return Meets(tree, *round, around.center, around.axes, extra, root);
  }
  const Mesh& mesh = *std::get<std::shared_ptr<const Mesh>>(obstacle.shape);
  const Matrix3d R = RotationInto(placed.cos, placed.sin, placed.mirrored);
  const Vector3d p_WS(placed.X_WS.x, placed.X_WS.y, placed.X_WS.height);
  const Vector3d origin = R * (obstacle.X_WO.translation() - p_WS);
  const Matrix3d axes = R * obstacle.X_WO.linear();
  if (Meets(tree, mesh.triangles, origin, axes, extra)) return true;
  // No part of the volume is cut by the surface: each is inside or outside.
  return std::any_of(tree.parts.begin(), tree.parts.end(), [&](const Vector3d& part) {
    const Vector3d p = axes.transpose() * (part - origin);
    const Eigen::Array3d off = (p - obstacle.around.center).cwiseAbs().array();
    return (off <= obstacle.around.half.array()).all() && mesh.interior.Contains(p);
  });
}

bool SweptVolumeQuery::IsFree(const Placed& placed, double extra) const {
  HALFSTEP_CHECK(placed.X_WS.AllFinite(), "the sole's pose is not finite");
  if (!placed.volume || (level_ && placed.X_WS.height != *level_)) return false;
  __builtin_prefetch(&placed.bounds.root);
  __builtin_prefetch(&*placed.volume);
  if (tree_.nodes.empty()) return true;
  if (tree_.nodes[0].left < 0) return !MeetsLeaf(placed, tree_.nodes[0], extra);
  const double sign = placed.mirrored ? -1.0 : 1.0;
  const Vector3d middle(placed.bounds.middle.x(), sign * placed.bounds.middle.y(),
                        placed.bounds.middle.z() + placed.X_WS.height);
  // Twice the slack of a leaf's places: where one of them is near, so are the nodes above it,
  // however both round. What is free does not depend on the tree then.
  const Vector3d half = placed.bounds.half.array() + 2.0 * Slack(placed, extra);
  int32_t stack[BoundsTree::kDeepest];
  int top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const BoundsTree::Node& node = Nth(tree_.nodes, stack[--top]);
    // The upright cylinder around the node's box.
    const double x = node.center.x() - placed.X_WS.x, y = node.center.y() - placed.X_WS.y;
    const double radius = node.half.head<2>().norm();
    if (std::abs(placed.cos * x + placed.sin * y - middle.x()) > half.x() + radius ||
        std::abs(placed.cos * y - placed.sin * x - middle.y()) > half.y() + radius ||
        std::abs(node.center.z() - middle.z()) > half.z() + node.half.z()) {
      continue;
    }
    if (node.left >= 0) {
      stack[top++] = node.left + 1;
      stack[top++] = node.left;
    } else if (MeetsLeaf(placed, node, extra)) {
      return false;
    }
  }
  return true;
}

double SweptVolumeQuery::Slack(const Placed& placed, double extra) const {
  return extra + 1e-6 * (1.0 + farthest_ + std::abs(placed.X_WS.x) + std::abs(placed.X_WS.y) +
                         std::abs(placed.X_WS.height));
}

bool SweptVolumeQuery::MeetsLeaf(const Placed& placed, const BoundsTree::Node& leaf,
                                 double extra) const {
  const double sign = placed.mirrored ? -1.0 : 1.0;
  const Vector3d& middle = placed.bounds.middle;
  const Vector3d half = placed.bounds.half.array() + Slack(placed, extra);
  const auto four = [](double value) { return Four(static_cast<float>(value)); };
  const Four X = four(placed.X_WS.x), Y = four(placed.X_WS.y), C = four(placed.cos),
             S = four(placed.sin);
  const Four mx = four(middle.x()), my = four(sign * middle.y()),
             mz = four(middle.z() + placed.X_WS.height);
  const Four hx = four(half.x()), hy = four(half.y()), hz = four(half.z());
  const size_t first = static_cast<size_t>(Nth(leaf_begins_, &leaf - tree_.nodes.data())) / 4;
  const size_t end = first + (static_cast<size_t>(leaf.count) + 3) / 4;
  for (size_t block = first; block < end; ++block) {
    const Cylinders& o = cylinders_[block];
    const Four x = Four::Load(o.x) - X, y = Four::Load(o.y) - Y, radius = Four::Load(o.radius);
    int near = (C * x + S * y - mx).Abs().Within(hx + radius) &
               (C * y - S * x - my).Abs().Within(hy + radius) &
               (Four::Load(o.z) - mz).Abs().Within(hz + Four::Load(o.half_height));
    for (; near != 0; near &= near - 1) {
      const size_t k = static_cast<size_t>(std::countr_zero(static_cast<unsigned>(near)));
      const Prepared& place = Nth(places_, place_at_[4 * block + k]);
      if (place.top <= placed.above) continue;
      if (MeetsObstacle(*placed.volume, placed, place, Seen(placed, place), extra + place.extra)) {
        return true;
      }
    }
  }
  return false;
}

SweptVolumeQuery::PlacedParts SweptVolumeQuery::Down(int i, Side support,
                                                     const Foothold& X_WS) const {
  const auto [s, c] = SinCos(X_WS.yaw);
  const bool mirrored = support == Side::kRight;
  PlacedParts parts{{Nth(volumes_.down, i), Nth(down_bounds_, i), mirrored, X_WS, c, s}};
  if (level_) return parts;
  const double landing = X_WS.height + Nth(volumes_.set.placements, i).height;
  parts.swing.emplace(Placed{Nth(volumes_.down_swing, i), Nth(down_swing_bounds_, i), mirrored,
                             X_WS, c, s, landing + kSameLevel});
  parts.stand.emplace(Placed{Nth(volumes_.down_stand, i), Nth(down_stand_bounds_, i), mirrored,
                             X_WS, c, s, X_WS.height + kSameLevel});
  return parts;
}

SweptVolumeQuery::PlacedParts SweptVolumeQuery::Up(int i, Side support,
                                                   const Foothold& X_WS) const {
  // The foot that has landed supports.
  const Foothold X_WF = X_WS * volumes_.set.Placement(i, support);
  const auto [s, c] = SinCos(X_WF.yaw);
  const bool mirrored = support == Side::kLeft;
  PlacedParts parts{{Nth(volumes_.up, i), Nth(up_bounds_, i), mirrored, X_WF, c, s}};
  if (level_) return parts;
  parts.swing.emplace(Placed{Nth(volumes_.up_swing, i), Nth(up_swing_bounds_, i), mirrored, X_WF, c,
                             s, X_WS.height + kSameLevel});
  parts.stand.emplace(Placed{Nth(volumes_.up_stand, i), Nth(up_stand_bounds_, i), mirrored, X_WF, c,
                             s, X_WF.height + kSameLevel});
  return parts;
}

bool SweptVolumeQuery::Bears(const Foothold& X_WF) const {
  if (level_) return X_WF.height == *level_;
  if (levels_.empty()) return X_WF.height == ground_->HeightEverywhere();
  const int level = levels_.LevelAt(X_WF.height);
  if (level < 0) return false;
  return foothold_ > 0.0
             ? levels_.NearestTo(sole_outline_, X_WF.Planar(), level).distance >= foothold_
             : levels_.Bears(sole_outline_, X_WF.Planar(), level);
}

std::vector<SweptVolumeQuery::Bounds> SweptVolumeQuery::BoundsOf(
    const std::vector<std::optional<BoxTree>>& volumes) {
  std::vector<Bounds> all;
  for (const auto& tree : volumes) {
    // Of nothing: a box that none reaches.
    Bounds bounds{.middle = Vector3d::Constant(1e30), .half = Vector3d::Zero(), .root = {}};
    if (tree && !tree->nodes.empty()) {
      const Vector3d lower = tree->Lower(), upper = tree->Upper();
      bounds = {.middle = 0.5 * (lower + upper),
                .half = 0.5 * (upper - lower),
                .empty = false,
                .root = tree->nodes.front()};
    }
    all.push_back(bounds);
  }
  return all;
}

bool SweptVolumeQuery::DownIsFree(int i, Side support, const Foothold& X_WS) const {
  if (!level_ && !Bears(X_WS * volumes_.set.Placement(i, support))) return false;
  if (!IsFree(Down(i, support, X_WS), 0.0)) return false;
  return areas_.empty() ||
         areas_.Clears((X_WS * volumes_.set.Placement(i, support)).Planar(), no_step_);
}

bool SweptVolumeQuery::UpIsFree(int i, Side support, const Foothold& X_WS) const {
  return IsFree(Up(i, support, X_WS), 0.0);
}

double SweptVolumeQuery::Clearance(const PlacedParts& placed, double cap) const {
  constexpr double kResolution = 1e-3;  // [m]
  if (!IsFree(placed, 0.0)) return 0.0;
  if (IsFree(placed, cap)) return cap;
  double free = 0.0, taken = cap;
  while (taken - free > kResolution) {
    const double mid = 0.5 * (free + taken);
    (IsFree(placed, mid) ? free : taken) = mid;
  }
  return free;
}

double SweptVolumeQuery::DownClearance(int i, Side support, const Foothold& X_WS,
                                       double cap) const {
  return Clearance(Down(i, support, X_WS), cap);
}

double SweptVolumeQuery::UpClearance(int i, Side support, const Foothold& X_WS, double cap) const {
  return Clearance(Up(i, support, X_WS), cap);
}

}  // namespace halfstep
