#include "planner/scene/obstacle_motion.h"

#include <algorithm>
#include <cmath>

#include "wpg/geometry/rotation.h"

namespace halfstep {
namespace {

using Waypoint = ObstacleMotion::Waypoint;

Waypoint Before(const ObstacleMotion& motion, const Eigen::Isometry3d& X_WO, size_t i) {
  if (i == 0) return {.t = 0.0, .translation = X_WO.translation(), .yaw = 0.0};
  return motion.waypoints[i - 1];
}

// The first waypoint after t, at which the motion of that time ends.
size_t NextAfter(const std::vector<Waypoint>& waypoints, double t) {
  const auto after =
      std::upper_bound(waypoints.begin(), waypoints.end(), t,
                       [](double time, const Waypoint& waypoint) { return time < waypoint.t; });
  return static_cast<size_t>(after - waypoints.begin());
}

// Where the frame is at t.
Waypoint FrameAt(const ObstacleMotion& motion, const Eigen::Isometry3d& X_WO, double t) {
  const size_t next = NextAfter(motion.waypoints, t);
  Waypoint at = Before(motion, X_WO, next);
  if (next == motion.waypoints.size() || t <= 0.0) return at;
  const Waypoint& to = motion.waypoints[next];
  const double s = (t - at.t) / (to.t - at.t);
  at.translation += s * (to.translation - at.translation);
  at.yaw += s * (to.yaw - at.yaw);
  return at;
}

}  // namespace

Eigen::Isometry3d ObstacleMotion::PoseAt(const Eigen::Isometry3d& X_WO, double t) const {
  if (waypoints.empty() || t <= 0.0) return X_WO;
  const Waypoint at = FrameAt(*this, X_WO, t);
  Eigen::Isometry3d X = X_WO;
  X.translation() = at.translation;
  if (at.yaw != 0.0) {
    X.linear() = AxisRotation(at.yaw, Eigen::Vector3d::UnitZ()) * X_WO.linear();
  }
  return X;
}

double ObstacleMotion::UncertaintyAt(double t) const {
  return speed == 0.0 ? error : error + speed * std::min(std::abs(t - measured_at), horizon);
}

double ObstacleMotion::UncertaintyRateAt(double t) const {
  const double since = t - measured_at;
  if (since >= horizon || since < -horizon) return 0.0;
  return since >= 0.0 ? speed : -speed;
}

Eigen::Vector3d ObstacleMotion::VelocityAt(const Eigen::Isometry3d& X_WO, double t,
                                           const Eigen::Vector3d& p_W) const {
  if (waypoints.empty() || t < 0.0) return Eigen::Vector3d::Zero();
  const size_t next = NextAfter(waypoints, t);
  if (next == waypoints.size()) return Eigen::Vector3d::Zero();
  const Waypoint from = Before(*this, X_WO, next);
  const Waypoint& to = waypoints[next];
  const double lasts = to.t - from.t;
  const Eigen::Vector3d lever = p_W - PoseAt(X_WO, t).translation();
  return (to.translation - from.translation) / lasts +
         (to.yaw - from.yaw) / lasts * Eigen::Vector3d::UnitZ().cross(lever);
}

double ObstacleMotion::SpeedTo(size_t index, const Eigen::Isometry3d& X_WO, double radius) const {
  const Waypoint from = Before(*this, X_WO, index);
  const Waypoint& to = waypoints[index];
  const double way =
      (to.translation - from.translation).norm() + std::abs(to.yaw - from.yaw) * radius;
  return way / (to.t - from.t);
}

double ObstacleMotion::WaypointSpeed(const Eigen::Isometry3d& X_WO, double radius) const {
  double fastest = 0.0;
  for (size_t i = 0; i < waypoints.size(); ++i) {
    fastest = std::max(fastest, SpeedTo(i, X_WO, radius));
  }
  return fastest;
}

double ObstacleMotion::DisplacementAt(const Eigen::Isometry3d& X_WO, double radius,
                                      double t) const {
  if (waypoints.empty() || t <= 0.0) return 0.0;
  const Waypoint at = FrameAt(*this, X_WO, t);
  return (at.translation - X_WO.translation()).norm() + std::min(std::abs(at.yaw), 2.0) * radius;
}

}  // namespace halfstep
