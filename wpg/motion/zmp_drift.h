#pragma once

#include <optional>

#include "wpg/motion/link_motions.h"

namespace halfstep {

/// How far the whole robot's ZMP can go over an interval from where it is at the midpoint m. About
/// the point p of the floor that is the ZMP at m, the floor's force has no horizontal moment n at
/// m; so p(t) − p = (−n_y, n_x)/f_z, ‖n(t)‖ ≤ h·sup‖ṅ‖.
/// Source: smoothing/README.md, "The robot's ZMP between instants".
struct ZmpDrift {
  double half_width = 0.0;  ///< h [s]
  VectorBall moment_rate;   ///< ṅ over the interval [N m/s]
  double least_push = 0.0;  ///< of the floor, f_z [N] > 0

  /// A bound of |direction·(p(t) − p(m))| for a unit vector in the plane [m].
  double Along(const Eigen::Vector2d& direction) const;

  /// None where LinkMotions has none, or the floor may not push. Precondition: as
  /// LinkMotions::Over, and at_m.Zmp() exists.
  static std::optional<ZmpDrift> Over(const RobotModel& robot, const IntervalMotion& motion,
                                      const WalkThirds& thirds, const RobotDynamics& at_m,
                                      double gravity);
};

}  // namespace halfstep
