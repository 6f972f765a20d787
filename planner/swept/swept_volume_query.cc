#include "planner/swept/swept_volume_query.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "planner/swept/four_floats.h"
#include "wpg/check.h"

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
  auto shared = std::make_shared<Mesh>(Mesh{TriangleTree(mesh), MeshInterior(mesh)});
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
      areas_(scene, sole_outline),
      no_step_(no_step) {
  const size_t size = static_cast<size_t>(volumes.set.size());
  HALFSTEP_CHECK(volumes.down.size() == size && volumes.up.size() == size,
                 volumes.down.size() << " and " << volumes.up.size() << " volumes of " << size);
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
  // Unused places hold nothing: no cylinder reaches from there.
  Cylinders nothing;
  for (int k = 0; k < 4; ++k) {
    nothing.x[k] = nothing.y[k] = nothing.z[k] = std::numeric_limits<float>::infinity();
    nothing.radius[k] = nothing.half_height[k] = 0.0f;
  }
  cylinders_.assign((all.size() + 3) / 4, nothing);
  for (size_t i = 0; i < all.size(); ++i) Put(i, all[i].X_WO);
}

void SweptVolumeQuery::SetObstaclePose(int obstacle, const Isometry3d& X_WO) {
  HALFSTEP_CHECK(obstacle >= 0 && obstacle < static_cast<int>(only_places_.size()),
                 "obstacle " << obstacle);
  const int place = only_places_[static_cast<size_t>(obstacle)];
  HALFSTEP_CHECK(place >= 0, "obstacle " << obstacle << " has waypoints");
  Put(static_cast<size_t>(place), X_WO);
}

void SweptVolumeQuery::Put(size_t index, const Isometry3d& X_WO) {
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
  Cylinders& four = cylinders_[index / 4];
  const size_t k = index % 4;
  four.x[k] = static_cast<float>(o.around_W.center.x());
  four.y[k] = static_cast<float>(o.around_W.center.y());
  four.z[k] = static_cast<float>(o.around_W.center.z());
  four.radius[k] = static_cast<float>(radius + o.extra);
  four.half_height[k] = static_cast<float>(reach.row(2).sum() + o.extra);
  farthest_ = std::max(farthest_, o.around_W.center.cwiseAbs().maxCoeff() + o.around_W.half.sum());
}

bool SweptVolumeQuery::MeetsObstacle(const BoxTree& tree, const Placed& placed,
                                     const Prepared& obstacle, double extra) const {
  // Seen from the support sole, and in the mirror for a right support.
  const double c = placed.cos, s = placed.sin, sign = placed.mirrored ? -1.0 : 1.0;
  Matrix3d R;
  R << c, s, 0, -sign * s, sign * c, 0, 0, 0, 1;
  const Vector3d p_WS(placed.X_WS.x, placed.X_WS.y, 0.0);
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
  if (!placed.volume) return false;
  const double sign = placed.mirrored ? -1.0 : 1.0;
  const auto& [middle, bounds, root] = placed.bounds;
  __builtin_prefetch(root);
  __builtin_prefetch(&*placed.volume);
  // For the rounding of float coordinates.
  const double slack =
      extra + 1e-6 * (1.0 + farthest_ + std::abs(placed.X_WS.x) + std::abs(placed.X_WS.y));
  const Vector3d half = bounds.array() + slack;
  const auto four = [](double value) { return Four(static_cast<float>(value)); };
  const Four X = four(placed.X_WS.x), Y = four(placed.X_WS.y), C = four(placed.cos),
             S = four(placed.sin);
  const Four mx = four(middle.x()), my = four(sign * middle.y()), mz = four(middle.z());
  const Four hx = four(half.x()), hy = four(half.y()), hz = four(half.z());
  for (size_t block = 0; block < cylinders_.size(); ++block) {
    const Cylinders& o = cylinders_[block];
    const Four x = Four::Load(o.x) - X, y = Four::Load(o.y) - Y, radius = Four::Load(o.radius);
    int near = (C * x + S * y - mx).Abs().Within(hx + radius) &
               (C * y - S * x - my).Abs().Within(hy + radius) &
               (Four::Load(o.z) - mz).Abs().Within(hz + Four::Load(o.half_height));
    for (; near != 0; near &= near - 1) {
      const size_t k = static_cast<size_t>(std::countr_zero(static_cast<unsigned>(near)));
      const Prepared& place = places_[4 * block + k];
      if (MeetsObstacle(*placed.volume, placed, place, extra + place.extra)) return false;
    }
  }
  return true;
}

SweptVolumeQuery::Placed SweptVolumeQuery::Down(int i, Side support, const Footprint& X_WS) const {
  const size_t e = static_cast<size_t>(i);
  return {volumes_.down[e],   down_bounds_[e],   support == Side::kRight, X_WS,
          std::cos(X_WS.yaw), std::sin(X_WS.yaw)};
}

SweptVolumeQuery::Placed SweptVolumeQuery::Up(int i, Side support, const Footprint& X_WS) const {
  // The foot that has landed supports.
  const size_t e = static_cast<size_t>(i);
  const Footprint X_WF = X_WS * volumes_.set.Placement(i, support);
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

bool SweptVolumeQuery::DownIsFree(int i, Side support, const Footprint& X_WS) const {
  if (!IsFree(Down(i, support, X_WS), 0.0)) return false;
  return areas_.empty() || areas_.Clears(X_WS * volumes_.set.Placement(i, support), no_step_);
}

bool SweptVolumeQuery::UpIsFree(int i, Side support, const Footprint& X_WS) const {
  return IsFree(Up(i, support, X_WS), 0.0);
}

double SweptVolumeQuery::Clearance(const Placed& placed, double horizon) const {
  constexpr double kResolution = 1e-3;  // [m]
  if (!IsFree(placed, 0.0)) return 0.0;
  if (IsFree(placed, horizon)) return horizon;
  double free = 0.0, taken = horizon;
  while (taken - free > kResolution) {
    const double mid = 0.5 * (free + taken);
    (IsFree(placed, mid) ? free : taken) = mid;
  }
  return free;
}

double SweptVolumeQuery::DownClearance(int i, Side support, const Footprint& X_WS,
                                       double horizon) const {
  return Clearance(Down(i, support, X_WS), horizon);
}

double SweptVolumeQuery::UpClearance(int i, Side support, const Footprint& X_WS,
                                     double horizon) const {
  return Clearance(Up(i, support, X_WS), horizon);
}

}  // namespace halfstep
