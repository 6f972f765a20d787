#include "planner/collision/collision_world.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <mutex>
#include <optional>
#include <queue>
#include <tuple>
#include <type_traits>
#include <utility>

#include "planner/scene/solid_body.h"
#include "wpg/check.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

void CheckFinite(const Eigen::Isometry3d& X) {
  HALFSTEP_CHECK(std::isfinite(X.matrix().topRows<3>().sum()), "a pose is not finite:\n"
                                                                   << X.matrix());
}

void CheckTime(double t) { HALFSTEP_CHECK(std::isfinite(t), "t = " << t); }

// From a point to a box along each axis, 0 where it is beside or inside [m].
Eigen::Vector3d ToBox(const Eigen::Vector3d& p, const Eigen::AlignedBox3d& box) {
  return (box.min() - p).cwiseMax(p - box.max()).cwiseMax(0.0);
}

}  // namespace

// What queries need of the obstacles; meshes from the beginning, others when they are near.
struct CollisionWorld::Shapes {
  explicit Shapes(size_t count) : once(count), made(count) { shapes.reserve(count); }

  std::vector<Shape> shapes;  // without the meshes' triangles, which `made` has
  std::vector<std::once_flag> once;
  std::vector<std::optional<CollisionShape>> made;
};

void CollisionWorld::Uncertainty::Add(const ObstacleMotion& motion) {
  first = any ? std::min(first, motion.measured_at) : motion.measured_at;
  last = any ? std::max(last, motion.measured_at) : motion.measured_at;
  any = true;
  error = std::max(error, motion.error);
  speed = std::max(speed, motion.speed);
  horizon = std::max(horizon, motion.horizon);
}

double CollisionWorld::Uncertainty::Most(double t, double half_width) const {
  if (!any) return 0.0;
  const double since = std::min(std::max(std::abs(t - first), std::abs(t - last)), horizon);
  return (error + speed * (since + half_width)) * (1 + 1e-12);
}

CollisionWorld::CollisionWorld(const Scene& scene)
    : has_solids_(!scene.ground->Solids().empty()),
      shapes_(std::make_shared<Shapes>(scene.obstacles.size() + scene.ground->Solids().size())) {
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.reserve(shapes_->once.size());
  entries_.reserve(shapes_->once.size());
  for (const Obstacle& obstacle : scene.obstacles) {
    Add(obstacle, std::numeric_limits<double>::infinity(), &boxes);
  }
  for (const GroundSolid& solid : scene.ground->Solids()) Add(BodyOf(solid), solid.top, &boxes);
  tree_ = BoundsTree(boxes, 4);
}

void CollisionWorld::Add(const Obstacle& obstacle, double top,
                         std::vector<Eigen::AlignedBox3d>* boxes) {
  CheckFinite(obstacle.X_WO);
  const int index = num_obstacles();
  const bool still = obstacle.rests() && obstacle.motion.error == 0.0;
  const bool has_waypoints = !obstacle.motion.waypoints.empty();
  const double radius = has_waypoints ? RadiusAboutOrigin(obstacle.shape) : 0.0;
  entries_.push_back({obstacle.X_WO, obstacle.motion, obstacle.speed(), radius, still,
                      BoundsOf(obstacle.shape, obstacle.X_WO), top});
  if (const auto* mesh = std::get_if<TriangleMesh>(&obstacle.shape)) {
    Nth(shapes_->made, index).emplace(*mesh);
    shapes_->shapes.emplace_back();
  } else {
    shapes_->shapes.push_back(obstacle.shape);
  }
  if (has_waypoints) {
    on_the_way_.push_back(index);
  } else {
    in_tree_.push_back(index);
    boxes->push_back(entries_.back().bounds_W);
    if (!still) uncertainty_.Add(obstacle.motion);
  }
}

const CollisionShape& CollisionWorld::ShapeOf(int obstacle) const {
  auto& made = Nth(shapes_->made, obstacle);
  std::call_once(Nth(shapes_->once, obstacle), [&] {
    if (!made) made.emplace(Nth(shapes_->shapes, obstacle));
  });
  return *made;
}

CollisionWorld::Nearest CollisionWorld::FindNearest(const CollisionShape& body,
                                                    const Eigen::Isometry3d& X_WB, double t,
                                                    double cap, double half_width,
                                                    double above) const {
  CheckFinite(X_WB);
  CheckTime(t);
  Nearest nearest;
  nearest.margin = nearest.separation.distance = cap;
  double least = cap;  // margin at the worst time
  const Eigen::Vector3d center_W = X_WB * body.center();
  // Lower bounds of that, the least first: of an obstacle, or of those of a node of the tree.
  using Candidate =
      std::tuple<double, bool, int>;  // bound, is an obstacle, its index or the node's
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> candidates;
  const auto add = [&](double bound, bool is_obstacle, int index) {
    // A negative bound says nothing about how deep the overlap may be.
    if (bound < std::max(least, 0.0)) candidates.emplace(bound, is_obstacle, index);
  };
  const auto add_obstacle = [&](int i) {
    const Entry& entry = Nth(entries_, i);
    if (entry.top <= above) return;
    add(ToBox(center_W, entry.bounds_W).norm() - body.radius() -
            (Moved(entry, t) + Taken(entry, t, half_width)),
        true, i);
  };
  const double taken = body.radius() + uncertainty_.Most(t, half_width) +
                       1e-12 * (1.0 + center_W.norm() + tree_.Farthest());
  const auto add_node = [&](int n) {
    add(BoundsTree::Gap(Nth(tree_.nodes, n), center_W) - taken, false, n);
  };
  for (const int i : on_the_way_) add_obstacle(i);
  if (!tree_.nodes.empty()) add_node(0);
  while (!candidates.empty()) {
    const auto [bound, is_obstacle, i] = candidates.top();
    if (bound >= std::max(least, 0.0)) break;
    candidates.pop();
    if (!is_obstacle) {
      const BoundsTree::Node& node = Nth(tree_.nodes, i);
      if (node.left >= 0) {
        add_node(node.left);
        add_node(node.left + 1);
        continue;
      }
      for (int32_t k = node.first; k < node.first + node.count; ++k) {
        add_obstacle(Nth(in_tree_, Nth(tree_.order, k)));
      }
      continue;
    }
    const Entry& entry = Nth(entries_, i);
    const double off = Taken(entry, t, half_width);
    // Rounding must not make what is not looked at the nearest.
    const Separation separation =
        Separate(body, X_WB, ShapeOf(i), entry.motion.PoseAt(entry.X_WO, t), least + off + 1e-9);
    const double worst = separation.distance - off;
    if (worst < least) {
      least = worst;
      nearest = {i, separation, separation.distance - entry.motion.UncertaintyAt(t)};
    }
  }
  return nearest;
}

bool CollisionWorld::Clears(const CollisionShape& body, const Eigen::Isometry3d& X_WB, double t,
                            double clearance, Scratch* scratch, double half_width,
                            double above) const {
  CheckFinite(X_WB);
  CheckTime(t);
  const Eigen::Vector3d center_W = X_WB * body.center();
  std::vector<int>& near = scratch->near;
  near = on_the_way_;
  tree_.ForEachNear(center_W,
                    std::max(body.radius() + clearance + uncertainty_.Most(t, half_width), 0.0),
                    [&](int32_t i) { near.push_back(Nth(in_tree_, i)); });
  std::sort(near.begin(), near.end());
  for (const int i : near) {
    const Entry& entry = Nth(entries_, i);
    if (entry.top <= above) continue;
    const double distance = clearance + Taken(entry, t, half_width);
    const double reach = body.radius() + distance + Moved(entry, t);
    const double distance2 = ToBox(center_W, entry.bounds_W).squaredNorm();
    if (distance2 > 0 && (reach <= 0 || distance2 >= reach * reach)) continue;
    Eigen::Vector3d& normal_W =
        scratch->normals_W.try_emplace(i, Eigen::Vector3d::Zero()).first->second;
    if (!ClearsAlongCached(body, X_WB, ShapeOf(i), entry.motion.PoseAt(entry.X_WO, t), distance,
                           &normal_W)) {
      return false;
    }
  }
  return true;
}

}  // namespace halfstep
