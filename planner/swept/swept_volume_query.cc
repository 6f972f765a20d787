#include "planner/swept/swept_volume_query.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "planner/swept/four_floats.h"
#include "wpg/check.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// Axis-aligned bounds of a convex body in its own frame.
OrientedBox Around(const ConvexBody& body) {
  const Vector3d sides(body.disc_radius, body.disc_radius, 0.0);
  const Vector3d lower = body.vertices.rowwise().minCoeff(),
                 upper = body.vertices.rowwise().maxCoeff();
  return {.center = 0.5 * (lower + upper),
          .half = (0.5 * (upper - lower) + sides).array() + body.ball_radius};
}

}  // namespace

void SweptVolumeQuery::Prepared::BeMesh(const TriangleMesh& mesh) {
  auto shared = std::make_shared<Mesh>(mesh);
  const TriangleTree::Node& root = shared->triangles.nodes[0];
  around = {.center = root.center, .half = root.half};
  shape = std::shared_ptr<const Mesh>(std::move(shared));
}

SweptVolumeQuery::Prepared SweptVolumeQuery::Prepare(const Obstacle& obstacle) {
  Prepared prepared;
  const auto round = [&prepared](const auto& of, const RoundBody& body) {
    prepared.around = Around(BodyOf(of));
    prepared.shape = body;
  };
  if (const auto* box = std::get_if<Box>(&obstacle.shape)) {
    prepared.around = Around(BodyOf(*box));
  } else if (const auto* sphere = std::get_if<Sphere>(&obstacle.shape)) {
    round(*sphere, {.ball_radius = sphere->radius});
  } else if (const auto* cylinder = std::get_if<Cylinder>(&obstacle.shape)) {
    round(*cylinder, {.half_length = 0.5 * cylinder->length, .disc_radius = cylinder->radius});
  } else if (const auto* capsule = std::get_if<Capsule>(&obstacle.shape)) {
    round(*capsule, {.half_length = 0.5 * capsule->length, .ball_radius = capsule->radius});
  } else if (const auto* mesh = std::get_if<TriangleMesh>(&obstacle.shape)) {
    prepared.BeMesh(*mesh);
  } else {
    const ConvexBody& body = std::get<ConvexBody>(obstacle.shape);
    prepared.around = Around(body);  // all that there is of a body with a disc
    if (body.disc_radius == 0 && !body.triangles.empty()) {
      prepared.BeMesh(FacesOf(body));
      prepared.extra = body.ball_radius;
    }
  }
  return prepared;
}

SweptVolumeQuery::SweptVolumeQuery(const SweptVolumes& volumes,
                                   const Eigen::Matrix2Xd& sole_outline, const Scene& scene,
                                   double no_step, double until)
    : volumes_(volumes),
      down_bounds_(BoundsOf(volumes.down)),
      up_bounds_(BoundsOf(volumes.up)),
      level_(scene.ground->HeightEverywhere()),
      areas_(scene, sole_outline),
      no_step_(no_step) {
  const size_t size = static_cast<size_t>(volumes.set.size());
  HALFSTEP_CHECK(volumes.down.size() == size && volumes.up.size() == size,
                 volumes.down.size() << " and " << volumes.up.size() << " volumes of " << size);
  for (const Foothold& X_SF : volumes.set.placements) X_SF.CheckLevel();
  CheckPlaces(scene, until);
  std::vector<ObstaclePlace> all;
  for (const Obstacle& obstacle : scene.obstacles) {
    only_places_.push_back(obstacle.motion.waypoints.empty() ? static_cast<int>(all.size()) : -1);
    const Prepared prepared = Prepare(obstacle);
    for (const ObstaclePlace& place : PlacesOf(obstacle, until)) {
      all.push_back(place);
      places_.push_back(prepared);
      places_.back().extra += place.extra;
    }
  }
  std::vector<Upright> cylinders;
  for (size_t i = 0; i < all.size(); ++i) cylinders.push_back(Move(i, all[i].X_WO));
  PlantTree(cylinders);
}

void SweptVolumeQuery::PlantTree(const std::vector<Upright>& cylinders) {
  constexpr int32_t kLeaf = 64;  // so many are looked at as fast as a few nodes
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const Upright& cylinder : cylinders) {
    const Vector3d half(cylinder.radius, cylinder.radius, cylinder.half_height);
    boxes.emplace_back(cylinder.center - half, cylinder.center + half);
  }
  tree_ = BoundsTree(boxes, kLeaf);
  leaf_begins_.assign(tree_.nodes.size(), -1);
  slots_.resize(cylinders.size());
  // Unused slots hold nothing: no cylinder reaches from there.
  Cylinders nothing;
  for (int k = 0; k < 4; ++k) {
    nothing.x[k] = nothing.y[k] = nothing.z[k] = std::numeric_limits<float>::infinity();
    nothing.radius[k] = nothing.half_height[k] = 0.0f;
  }
  for (size_t n = 0; n < tree_.nodes.size(); ++n) {
    const BoundsTree::Node& node = tree_.nodes[n];
    if (node.left >= 0) continue;
    leaf_begins_[n] = static_cast<int32_t>(place_at_.size());
    for (int32_t i = node.first; i < node.first + node.count; ++i) {
      const int32_t place = Nth(tree_.order, i);
      Nth(slots_, place) = static_cast<int32_t>(place_at_.size());
      place_at_.push_back(place);
    }
    place_at_.resize((place_at_.size() + 3) / 4 * 4, -1);
  }
  cylinders_.assign(place_at_.size() / 4, nothing);
  for (size_t i = 0; i < cylinders.size(); ++i) {
    Put(static_cast<size_t>(slots_[i]), cylinders[i]);
  }
}

void SweptVolumeQuery::SetObstaclePose(int obstacle, const Isometry3d& X_WO) {
  HALFSTEP_CHECK(obstacle >= 0 && obstacle < static_cast<int>(only_places_.size()),
                 "obstacle " << obstacle);
  const int place = Nth(only_places_, obstacle);
  HALFSTEP_CHECK(place >= 0, "obstacle " << obstacle << " has waypoints");
  const Upright cylinder = Move(static_cast<size_t>(place), X_WO);
  const int32_t slot = Nth(slots_, place);
  Put(static_cast<size_t>(slot), cylinder);
  // It stays in its leaf, and all nodes above grow around it.
  const auto at = std::find(tree_.order.begin(), tree_.order.end(), place) - tree_.order.begin();
  for (int32_t n = 0; n >= 0;) {
    BoundsTree::Node& node = Nth(tree_.nodes, n);
    const Vector3d half(cylinder.radius, cylinder.radius, cylinder.half_height);
    node.half = node.half.cwiseMax((cylinder.center - node.center).cwiseAbs() + half);
    n = node.left;
    if (n >= 0 && at >= tree_.nodes[static_cast<size_t>(n) + 1].first) ++n;
  }
}

SweptVolumeQuery::Upright SweptVolumeQuery::Move(size_t index, const Isometry3d& X_WO) {
  HALFSTEP_CHECK(X_WO.matrix().allFinite(), "place " << index << " at\n" << X_WO.matrix());
  Prepared& o = places_[index];
  o.X_WO = X_WO;
  o.around_W = {.center = X_WO * o.around.center,
                .half = o.around.half,
                .axes = X_WO.linear() * o.around.axes};
  // A box lying on a side stands upright all the same: the vertical axis last.
  if (std::holds_alternative<std::monostate>(o.shape)) {
    int vertical = 0;
    o.around_W.axes.row(2).cwiseAbs().maxCoeff(&vertical);
    o.around_W.axes.col(2).swap(o.around_W.axes.col(vertical));
    std::swap(o.around_W.half[2], o.around_W.half[vertical]);
  }
  const Matrix3d reach = o.around_W.axes.cwiseAbs() * o.around_W.half.asDiagonal();
  const bool upright = o.around_W.axes.row(2).head<2>().isZero(1e-12);
  const double radius = upright ? o.around_W.half.head<2>().norm() : o.around_W.half.norm();
  farthest_ = std::max(farthest_, o.around_W.center.cwiseAbs().maxCoeff() + o.around_W.half.sum());
  return {o.around_W.center, radius + o.extra, reach.row(2).sum() + o.extra};
}

void SweptVolumeQuery::Put(size_t slot, const Upright& cylinder) {
  Cylinders& four = cylinders_[slot / 4];
  const size_t k = slot % 4;
  four.x[k] = static_cast<float>(cylinder.center.x());
  four.y[k] = static_cast<float>(cylinder.center.y());
  four.z[k] = static_cast<float>(cylinder.center.z());
  four.radius[k] = static_cast<float>(cylinder.radius);
  four.half_height[k] = static_cast<float>(cylinder.half_height);
}

bool SweptVolumeQuery::MeetsObstacle(const BoxTree& tree, const Placed& placed,
                                     const Prepared& obstacle, double extra) const {
  // Seen from the support sole, and in the mirror for a right support.
  const double c = placed.cos, s = placed.sin, sign = placed.mirrored ? -1.0 : 1.0;
  Matrix3d R;
  R << c, s, 0, -sign * s, sign * c, 0, 0, 0, 1;
  const Vector3d p_WS(placed.X_WS.x, placed.X_WS.y, placed.X_WS.height);
  const OrientedBox around{.center = R * (obstacle.around_W.center - p_WS),
                           .half = obstacle.around_W.half,
                           .axes = R * obstacle.around_W.axes};
  if (std::holds_alternative<std::monostate>(obstacle.shape)) return Meets(tree, around, extra);
  if (const auto* round = std::get_if<RoundBody>(&obstacle.shape)) {
    return Meets(tree, *round, around.center, around.axes, extra);
  }
  const Mesh& mesh = *std::get<std::shared_ptr<const Mesh>>(obstacle.shape);
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
  if (!placed.volume || placed.X_WS.height != level_) return false;
  __builtin_prefetch(placed.bounds.root);
  __builtin_prefetch(&*placed.volume);
  if (tree_.nodes.empty()) return true;
  if (tree_.nodes[0].left < 0) return !MeetsLeaf(placed, tree_.nodes[0], extra);
  const double sign = placed.mirrored ? -1.0 : 1.0;
  const Vector3d middle(placed.bounds.middle.x(), sign * placed.bounds.middle.y(),
                        placed.bounds.middle.z() + placed.X_WS.height);
  const Vector3d half = placed.bounds.half.array() + Slack(placed, extra);
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
      if (MeetsObstacle(*placed.volume, placed, place, extra + place.extra)) return true;
    }
  }
  return false;
}

SweptVolumeQuery::Placed SweptVolumeQuery::Down(int i, Side support, const Foothold& X_WS) const {
  const size_t e = static_cast<size_t>(i);
  return {volumes_.down[e],   down_bounds_[e],   support == Side::kRight, X_WS,
          std::cos(X_WS.yaw), std::sin(X_WS.yaw)};
}

SweptVolumeQuery::Placed SweptVolumeQuery::Up(int i, Side support, const Foothold& X_WS) const {
  // The foot that has landed supports.
  const size_t e = static_cast<size_t>(i);
  const Foothold X_WF = X_WS * volumes_.set.Placement(i, support);
  return {volumes_.up[e], up_bounds_[e],      support == Side::kLeft,
          X_WF,           std::cos(X_WF.yaw), std::sin(X_WF.yaw)};
}

std::vector<SweptVolumeQuery::Bounds> SweptVolumeQuery::BoundsOf(
    const std::vector<std::optional<BoxTree>>& volumes) {
  std::vector<Bounds> all;
  for (const auto& tree : volumes) {
    // Of nothing: a box that none reaches.
    Bounds bounds{.middle = Vector3d::Constant(1e30), .half = Vector3d::Zero(), .root = nullptr};
    if (tree && !tree->nodes.empty()) {
      const Vector3d lower = tree->Lower(), upper = tree->Upper();
      bounds = {.middle = 0.5 * (lower + upper),
                .half = 0.5 * (upper - lower),
                .root = tree->nodes.data()};
    }
    all.push_back(bounds);
  }
  return all;
}

bool SweptVolumeQuery::DownIsFree(int i, Side support, const Foothold& X_WS) const {
  if (!IsFree(Down(i, support, X_WS), 0.0)) return false;
  return areas_.empty() ||
         areas_.Clears((X_WS * volumes_.set.Placement(i, support)).Planar(), no_step_);
}

bool SweptVolumeQuery::UpIsFree(int i, Side support, const Foothold& X_WS) const {
  return IsFree(Up(i, support, X_WS), 0.0);
}

double SweptVolumeQuery::Clearance(const Placed& placed, double cap) const {
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
