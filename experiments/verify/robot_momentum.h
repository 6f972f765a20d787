#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "experiments/verify/half_step_motion.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::verify {

/// A force [N] and its moment about the origin of W [N m].
struct Push {
  Eigen::Vector3d force{0, 0, 0}, moment{0, 0, 0};  ///< [N], [N m]

  /// Its moment about a point.
  Eigen::Vector3d About(const Eigen::Vector3d& point) const { return moment - point.cross(force); }
};

/// What moves the robot's bodies against gravity when the walk's quantities have these values and
/// derivatives. Every body counts as point masses with its mass, centre and inertia (negative ones
/// where no rigid body has such an inertia); their accelerations are differences of eighth order of
/// the places that inverse and forward kinematics give them while the quantities go along the
/// parabola of `at`. Nothing of the dynamics that the prover uses.
struct RobotMomentum {
  Push floor;                                            ///< on the whole robot
  std::array<std::array<Push, 6>, 2> links;              ///< on each leg link, by Index(Side)
  std::array<std::array<Eigen::Vector3d, 6>, 2> points;  ///< of the joints' axes, in W [m]
  std::array<std::array<Eigen::Vector3d, 6>, 2> axes;    ///< unit vectors in W

  /// None where masses are not known, a leg does not reach or the floor does not push. `near`:
  /// about the joint angles (PostureOf).
  static std::optional<RobotMomentum> Of(const RobotModel& robot, const WalkInstant& at,
                                         const std::array<Vector6d, 2>& near);

  /// The point at a height [m] about which the floor's force has no horizontal moment, in W [m].
  Eigen::Vector2d Zmp(double height) const;
};

}  // namespace halfstep::verify
