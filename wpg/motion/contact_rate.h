#pragma once

#include <Eigen/Core>
#include <optional>

#include "wpg/motion/motion_bounds.h"
#include "wpg/motion/rigid_motion.h"
#include "wpg/motion/robot_drift.h"
#include "wpg/motion/robot_dynamics.h"
#include "wpg/motion/vector_ball.h"
#include "wpg/motion/walk_thirds.h"

namespace halfstep {

/// How fast what the floor gives to a robot changes over an interval [m − h, m + h], about the
/// point p of a horizontal plane that is the ZMP there at m: balls that hold the derivatives at all
/// times, and (n(t) − n(m))/(t − m) also where the walk's third derivatives jump within rounding of
/// the ends. In the axes of W. Source: smoothing/README.md, "Rates between instants".
struct ContactRate {
  double half_width = 0.0;        ///< h [s]
  VectorBall moment;              ///< of the moment about p [N m/s]
  VectorBall force;               ///< of the force [N/s]
  Eigen::Vector2d tilt = {0, 0};  ///< RobotDynamics::Tilt at m
  WrenchRounding off = {};        ///< of moment and force at m

  /// The same about the ZMP in the plane that is higher by `by` [m].
  ContactRate Raised(double by) const;

  /// Adds what a body asks for, of which `com` is the motion with its centre of mass as the point.
  void Add(const SpatialInertia& inertia, const RigidMotion& com, const Eigen::Vector3d& p,
           double gravity);

  /// In the plane z = `height` [m]. Preconditions: `motion` is bounded, `of_robot` is its drift,
  /// `at_m` are the dynamics at m, and at_m.Zmp() exists. None where the interval is too long for a
  /// bound.
  static std::optional<ContactRate> Over(const RobotModel& robot, const IntervalMotion& motion,
                                         const WalkThirds& thirds, const RobotDrift& of_robot,
                                         const RobotDynamics& at_m, double gravity,
                                         double height = 0.0);
};

}  // namespace halfstep
