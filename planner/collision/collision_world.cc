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

void CheckTime(double t) { HALFSTEP_CHECK(std::isfinite(t), "t = " << t); }

// From a point to a box along each axis, 0 where it is beside or inside [m].
Eigen::Vector3d ToBox(const Eigen::Vector3d& p, const Eigen::Vector3d& lower,
                      const Eigen::Vector3d& upper) {
  return (lower - p).cwiseMax(p - upper).cwiseMax(0.0);
}

}  // namespace

CollisionWorld::CollisionWorld(const Scene& scene) {
  for (const Obstacle& obstacle : scene.obstacles) {
    const Eigen::Isometry3d& X_WO = obstacle.X_WO;
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
    const bool still = obstacle.rests() && obstacle.motion.error == 0.0;
    still_ = still_ && still;
    const double radius =
        obstacle.motion.waypoints.empty() ? 0.0 : RadiusAboutOrigin(obstacle.shape);
    entries_.push_back({std::move(shape), obstacle, obstacle.speed(), radius, still});
    bounds_.push_back(bounds);
  }
}

CollisionWorld::Nearest CollisionWorld::FindNearest(const CollisionShape& body,
                                                    const Eigen::Isometry3d& X_WB, double t,
                                                    double horizon, double half_width) const {
  CheckFinite(X_WB);
  CheckTime(t);
  Nearest nearest;
  nearest.margin = nearest.separation.distance = horizon;
  double least = horizon;  // margin at the worst time
  const Eigen::Vector3d center_W = X_WB * body.center();
  std::vector<std::pair<double, int>> candidates;  // lower bound of that, obstacle
  for (size_t i = 0; i < bounds_.size(); ++i) {
    double bound = ToBox(center_W, bounds_[i].lower_W, bounds_[i].upper_W).norm() - body.radius();
    if (!still_) bound -= Moved(entries_[i], t) + Taken(entries_[i], t, half_width);
    // A negative bound says nothing about how deep the overlap may be.
    if (bound < std::max(horizon, 0.0)) candidates.emplace_back(bound, static_cast<int>(i));
  }
  std::sort(candidates.begin(), candidates.end());
  for (const auto& [bound, i] : candidates) {
    if (bound >= std::max(least, 0.0)) break;
    const Entry& entry = entries_[static_cast<size_t>(i)];
    const Separation separation = Separate(body, X_WB, entry.shape, entry.obstacle.PoseAt(t));
    const double worst = separation.distance - Taken(entry, t, half_width);
    if (worst < least) {
      least = worst;
      nearest = {i, separation, separation.distance - entry.obstacle.UncertaintyAt(t)};
    }
  }
  return nearest;
}

bool CollisionWorld::Clears(const CollisionShape& body, const Eigen::Isometry3d& X_WB, double t,
                            double clearance, Scratch* scratch, double half_width) const {
  CheckFinite(X_WB);
  CheckTime(t);
  if (scratch->normals_W.size() != entries_.size()) {
    scratch->normals_W.assign(entries_.size(), Eigen::Vector3d::Zero());
  }
  const Eigen::Vector3d center_W = X_WB * body.center();
  for (size_t i = 0; i < bounds_.size(); ++i) {
    const Entry& entry = entries_[i];
    const double distance = still_ ? clearance : clearance + Taken(entry, t, half_width);
    const double reach = body.radius() + distance + (still_ ? 0.0 : Moved(entry, t));
    const Eigen::Vector3d gap = ToBox(center_W, bounds_[i].lower_W, bounds_[i].upper_W);
    const double distance2 = gap.squaredNorm();
    if (distance2 > 0 && (reach <= 0 || distance2 >= reach * reach)) continue;
    if (!ClearsAlongCached(body, X_WB, entry.shape, entry.obstacle.PoseAt(t), distance,
                           &scratch->normals_W[i])) {
      return false;
    }
  }
  return true;
}

}  // namespace halfstep
