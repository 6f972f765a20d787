#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <limits>
#include <vector>

namespace halfstep {

/// What is known of where an obstacle is at a time t of the walk [s]: a pose at every t, and how
/// far from there it may be. Two parts, of which either may be missing:
///   - known motion, from waypoint to waypoint: straight, turning steadily about the world's z
///     through the origin of the obstacle's frame. Before t = 0 and after the last waypoint it
///     rests;
///   - uncertainty: every point of the obstacle is at most u(t) away from where it is said to be,
///         u(t) = error + speed · min(|t − measured_at|, horizon).
/// Source: planner/README.md, "Obstacles that move".
struct ObstacleMotion {
  /// Where the frame is at the time t. The first one, at t = 0, is the obstacle's own pose and is
  /// not listed.
  struct Waypoint {
    double t = 0.0;                        ///< of the walk [s], > 0 and increasing.
    Eigen::Vector3d translation{0, 0, 0};  ///< of the frame's origin, in W [m].
    double yaw = 0.0;  ///< R = R_z(yaw) · R at t = 0 [rad]; not wrapped: 2π is a full turn.
  };

  std::vector<Waypoint> waypoints{};  ///< known motion, in the order of time; empty: none is known
  double error = 0.0;                 ///< r ≥ 0 [m]
  double speed = 0.0;                 ///< v ≥ 0 [m/s], beyond the known motion.
  double measured_at = 0.0;           ///< t_m [s]
  /// How long the uncertainty grows before and after t_m [s] ≥ 0. Where it is finite, what is
  /// proved holds until t_m + horizon, or until a new measurement.
  double horizon = std::numeric_limits<double>::infinity();

  /// Whether pose and uncertainty are the same at all times.
  bool rests() const { return waypoints.empty() && speed == 0.0; }

  /// The pose at t [s] of an obstacle that is at X_WO at t = 0.
  Eigen::Isometry3d PoseAt(const Eigen::Isometry3d& X_WO, double t) const;
  /// u(t) [m].
  double UncertaintyAt(double t) const;
  /// The derivative of u, towards later times where it has two [m/s].
  double UncertaintyRateAt(double t) const;
  /// The velocity at t of the point of the obstacle that is at p_W [m] then, by the known motion,
  /// towards later times where it has two [m/s].
  Eigen::Vector3d VelocityAt(const Eigen::Isometry3d& X_WO, double t,
                             const Eigen::Vector3d& p_W) const;

  /// A speed that no point exceeds by the known motion, when all points are within `radius` [m] of
  /// the frame's origin [m/s].
  double WaypointSpeed(const Eigen::Isometry3d& X_WO, double radius) const;
  /// The same on the way to a waypoint. Precondition: 0 ≤ index < size.
  double SpeedTo(size_t index, const Eigen::Isometry3d& X_WO, double radius) const;
  /// How far such a point is at t from its place at t = 0 by the known motion, at most [m].
  double DisplacementAt(const Eigen::Isometry3d& X_WO, double radius, double t) const;
};

}  // namespace halfstep
