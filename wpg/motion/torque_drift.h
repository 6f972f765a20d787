#pragma once

#include "wpg/motion/foot_loads.h"
#include "wpg/motion/robot_drift.h"

namespace halfstep {

/// How much the exact torques of leg joints differ at most, for all t of an interval, from those
/// computed at its midpoint m. A joint's torque is its axis times the moment about its point of all
/// bodies, each with a weight: 1 − λ for those that hang on the joint, −λ for all others, λ the
/// share of the leg's foot in what the floor gives. Source: smoothing/README.md, "Torques between
/// instants".
class TorqueDrift {
 public:
  /// Preconditions: `motion` is bounded, `at_m` are the dynamics at m and `drift` is of them,
  /// `loads` are those at m, and the same feet stand in all of the interval. `zmp_moved` is how far
  /// the robot's ZMP goes from where it is at m, at most, in the plane of each sole [m],
  /// `soles_off` how far rounding may carry corners and heights of the soles [m]; both of no
  /// account where one foot stands. What is passed is borrowed.
  TorqueDrift(const IntervalMotion& motion, const RobotDrift& drift, const RobotDynamics& at_m,
              const FootLoads& loads, double zmp_moved, double gravity, double soles_off = 0.0);

  /// By joint, from the waist down [N m].
  Vector6d Of(Side side) const;

 private:
  // A point and a direction that a joint's axis has at m, and how much they drift.
  struct Axis {
    Eigen::Vector3d point{0, 0, 0}, direction{0, 0, 0};  // from O, in the axes of W
    Eigen::Vector3d velocity{0, 0, 0};                   // of the point at m
    double p = 0.0, turned = 0.0, most_acceleration = 0.0;
    PointRounding off = {};  // of what it is at m; p and turned contain it
  };
  Axis AxisOf(Side side, size_t joint) const;
  double OfJoint(Side side, size_t joint) const;

  const IntervalMotion& motion_;
  const RobotDrift& drift_;
  const RobotDynamics& at_m_;
  const FootLoads& loads_;
  double share_drift_, soles_off_, gravity_;
};

}  // namespace halfstep
