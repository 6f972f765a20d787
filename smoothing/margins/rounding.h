#pragma once

#include "wpg/motion/walk_state.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// What is added to the bounds of proofs for the rounding of forces and joint accelerations: one
/// number for each kind, made from the robot, so that it is enough for a giant and does not eat up
/// what a dwarf has. These are not derived; each is a hundred times and more what was seen. Lengths
/// go by the leg's length ℓ, accelerations of joints by 1/ℓ as a pendulum's do, torques by m·g·ℓ.
/// Of places, angles and speeds rounding is bounded: IntervalMotion::rounding.
struct Rounding {
  /// That of a robot's walks.
  explicit Rounding(const RobotModel& robot);

  /// Of the whole robot's ZMP [m]. Joint accelerations are differences of nearly equal numbers, and
  /// those of legs without closed form follow from angles with residuals of 3e-14.
  double zmp;
  /// Of joint torques [N m]: the feet's shares multiply the ZMP's.
  double torque;
  double friction;      ///< of the needed coefficient of friction
  double acceleration;  ///< of joint accelerations [rad/s²]
};

/// How far rounding may carry the margin of a point inside the support polygon of soles that are
/// off by at most `off`, where the walk's quantities are `x` [m]. The polygon leaves out edges
/// below 1e-9 m, which is at most (1e-9 m)²/margin. Source: smoothing/README.md, "Rounding", 4.
double SupportRounding(const WalkState& x, const WalkState& off, const Eigen::Vector2d& sole_size,
                       double margin);

/// The same of the distance, seen from above, between a sole's outline about a place [m] and
/// another polygon, but for how far the place may be off: corners turned and moved, and their
/// differences.
double PlanarRounding(double x, double y);

/// How far rounding may carry a distance of the robot's bodies, or a height, from that of bodies
/// that are exactly where they were computed to be [m]: sums of products of their coordinates, and
/// of what is within 8 m. Obstacles' own coordinates are looked after in planner/collision.
double DistanceRounding(const WalkState& x);

}  // namespace halfstep
