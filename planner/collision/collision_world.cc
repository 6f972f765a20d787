#include "planner/collision/collision_world.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "wpg/check.h"

namespace halfstep {
namespace {

void CheckFinite(const Eigen::Isometry3d& X) {
  HALFSTEP_CHECK(std::isfinite(X.matrix().topRows<3>().sum()), "a pose is not finite:\n"
                                                                   << X.matrix());
}

// From a point to a box along each axis, 0 where it is beside or inside [m].
Eigen::Vector3d ToBox(const Eigen::Vector3d& p, const Eigen::Vector3d& lower,
                      const Eigen::Vector3d& upper) {
  return (lower - p).cwiseMax(p - upper).cwiseMax(0.0);
}

}  // namespace

CollisionWorld::CollisionWorld(const Scene& scene) : speed_(scene.speed()) {
  for (const Obstacle& obstacle : scene.obstacles) {
    const Eigen::Isometry3d& X_WO = obstacle.PoseAt(0.0);
    CheckFinite(X_WO);
    CollisionShape shape(obstacle.shape);
    Bounds bounds;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d direction = X_WO.linear().row(axis);
      const double origin = X_WO.translation()[axis];
      bounds.upper_W[axis] = origin + Support(shape.convex(), direction);
      bounds.lower_W[axis] = origin - Support(shape.convex(), -direction);
    }
    const double rounding = 1e-12 * (1 + bounds.lower_W.norm() + bounds.upper_W.norm());
    bounds.lower_W.array() -= rounding;
    bounds.upper_W.array() += rounding;
    entries_.push_back({std::move(shape), obstacle});
    bounds_.push_back(bounds);
  }
}

double CollisionWorld::MovedAt(double t) const {
  HALFSTEP_CHECK(std::isfinite(t), "t = " << t);
  return speed_ * std::abs(t);
}

CollisionWorld::Nearest CollisionWorld::FindNearest(const CollisionShape& body,
                                                    const Eigen::Isometry3d& X_WB, double t,
                                                    double horizon) const {
  CheckFinite(X_WB);
  const double moved = MovedAt(t);
  Nearest nearest;
  nearest.separation.distance = horizon;
  const Eigen::Vector3d center_W = X_WB * body.center();
  std::vector<std::pair<double, int>> candidates;  // lower bound of the distance, obstacle
  for (size_t i = 0; i < bounds_.size(); ++i) {
    const double bound =
        ToBox(center_W, bounds_[i].lower_W, bounds_[i].upper_W).norm() - body.radius() - moved;
    // A negative bound says nothing about how deep the overlap may be.
    if (bound < std::max(horizon, 0.0)) candidates.emplace_back(bound, static_cast<int>(i));
  }
  std::sort(candidates.begin(), candidates.end());
  for (const auto& [bound, i] : candidates) {
    if (bound >= std::max(nearest.separation.distance, 0.0)) break;
    const Entry& entry = entries_[static_cast<size_t>(i)];
    const Separation separation = Separate(body, X_WB, entry.shape, entry.obstacle.PoseAt(t));
    if (separation.distance < nearest.separation.distance) nearest = {i, separation};
  }
  return nearest;
}

bool CollisionWorld::Clears(const CollisionShape& body, const Eigen::Isometry3d& X_WB, double t,
                            double clearance, Scratch* scratch) const {
  CheckFinite(X_WB);
  if (scratch->normals_W.size() != entries_.size()) {
    scratch->normals_W.assign(entries_.size(), Eigen::Vector3d::Zero());
  }
  const Eigen::Vector3d center_W = X_WB * body.center();
  const double reach = body.radius() + clearance + MovedAt(t);
  for (size_t i = 0; i < bounds_.size(); ++i) {
    const Eigen::Vector3d gap = ToBox(center_W, bounds_[i].lower_W, bounds_[i].upper_W);
    const double distance2 = gap.squaredNorm();
    if (distance2 > 0 && (reach <= 0 || distance2 >= reach * reach)) continue;
    if (!ClearsAlongCached(body, X_WB, entries_[i].shape, entries_[i].obstacle.PoseAt(t), clearance,
                           &scratch->normals_W[i])) {
      return false;
    }
  }
  return true;
}

}  // namespace halfstep
