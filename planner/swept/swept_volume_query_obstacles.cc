// The obstacles of a SweptVolumeQuery: what is prepared of them, and the tree of where they are.

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "planner/scene/shape_extents.h"
#include "planner/swept/swept_volume_query.h"
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
  const auto box_around = [](const auto& of) {
    return OrientedBox{.center = Vector3d::Zero(), .half = HalfExtents(of)};
  };
  const auto round = [&](const auto& of, const RoundBody& body) {
    prepared.around = box_around(of);
    prepared.shape = body;
  };
  if (const auto* box = std::get_if<Box>(&obstacle.shape)) {
    prepared.around = box_around(*box);
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

void SweptVolumeQuery::PlantTree(const std::vector<Upright>& cylinders) {
  constexpr int32_t kLeaf = 64;  // so many are looked at as fast as a few nodes
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.reserve(cylinders.size());
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
  for (size_t i = 0; i < cylinders.size(); ++i) Put(slots_[i], cylinders[i]);
}

void SweptVolumeQuery::SetObstaclePose(int obstacle, const Isometry3d& X_WO) {
  HALFSTEP_CHECK(obstacle >= 0 && obstacle < static_cast<int>(only_places_.size()),
                 "obstacle " << obstacle);
  const int place = Nth(only_places_, obstacle);
  HALFSTEP_CHECK(place >= 0, "obstacle " << obstacle << " has waypoints");
  const Upright cylinder = Move(place, X_WO);
  Put(Nth(slots_, place), cylinder);
  // It stays in its leaf, and all nodes above grow around it.
  const auto at = std::find(tree_.order.begin(), tree_.order.end(), place) - tree_.order.begin();
  for (int32_t n = 0; n >= 0;) {
    BoundsTree::Node& node = Nth(tree_.nodes, n);
    const Vector3d half(cylinder.radius, cylinder.radius, cylinder.half_height);
    node.half = node.half.cwiseMax((cylinder.center - node.center).cwiseAbs() + half);
    n = node.left;
    if (n >= 0 && at >= Nth(tree_.nodes, n + 1).first) ++n;
  }
}

SweptVolumeQuery::Upright SweptVolumeQuery::Move(int index, const Isometry3d& X_WO) {
  HALFSTEP_CHECK(X_WO.matrix().allFinite(), "place " << index << " at\n" << X_WO.matrix());
  Prepared& o = Nth(places_, index);
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

void SweptVolumeQuery::Put(int32_t slot, const Upright& cylinder) {
  Cylinders& four = Nth(cylinders_, slot / 4);
  const int32_t k = slot % 4;
  four.x[k] = static_cast<float>(cylinder.center.x());
  four.y[k] = static_cast<float>(cylinder.center.y());
  four.z[k] = static_cast<float>(cylinder.center.z());
  four.radius[k] = static_cast<float>(cylinder.radius);
  four.half_height[k] = static_cast<float>(cylinder.half_height);
}

}  // namespace halfstep
