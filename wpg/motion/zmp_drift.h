#pragma once

#include <Eigen/Core>

#include "wpg/motion/contact_rate.h"
#include "wpg/motion/motion_bounds.h"
#include "wpg/motion/robot_drift.h"
#include "wpg/motion/robot_dynamics.h"
#include "wpg/motion/vector_ball.h"
#include "wpg/motion/walk_thirds.h"

namespace halfstep {

/// How far the exact robot's ZMP in a horizontal plane can be over an interval from where it is
/// computed at the midpoint m. About that point p of the plane, the floor's force has no horizontal
/// moment n at m but by rounding; so p(t) − p = (−n_y, n_x)/f_z, and n(t) is that and what the
/// parts of the robot have drifted by. Source: smoothing/README.md, "The robot's ZMP between
/// instants".
struct ZmpDrift {
  double half_width = 0.0;  ///< h [s]
  /// Rate of n that is known by direction: of the waist's part, for all t of the interval, and at m
  /// of the legs' weights [N m/s].
  VectorBall rate;
  double rest = 0.0;        ///< sup ‖n(t) − n(m)‖ of all else, and of rounding at m [N m]
  double least_push = 0.0;  ///< of the floor, f_z [N]; not positive: there is no bound
  /// Rate of the floor's force f that is known by direction, as of n [N/s].
  VectorBall force_rate = {};
  double force_rest = 0.0;        ///< sup ‖f(t) − f(m)‖ of all else [N]
  Eigen::Vector2d tilt = {0, 0};  ///< f_t/f_z at m

  /// A bound of |direction·(p(t) − p(m))| for a unit vector in the plane [m]; ∞: none.
  double Along(const Eigen::Vector2d& direction) const;

  /// A bound of ‖p(t) − p(m)‖ [m]; ∞: none.
  double Most() const;

  /// The same of the ZMP in the plane that is higher by `by` [m].
  ZmpDrift Raised(double by) const;

  /// From the rates of all parts; the floor pushes with `push` at m [N].
  static ZmpDrift At(const ContactRate& rate, double push);

  /// In the plane z = `height` [m]. Preconditions: `motion` is bounded, `of_robot` is its drift,
  /// `at_m` are the dynamics at m, and at_m.Zmp() exists.
  static ZmpDrift Over(const RobotModel& robot, const IntervalMotion& motion,
                       const WalkThirds& thirds, const RobotDrift& of_robot,
                       const RobotDynamics& at_m, double gravity, double height = 0.0);
};

}  // namespace halfstep
