#pragma once

#include <Eigen/Geometry>
#include <array>

#include "experiments/verify/half_step_motion.h"
#include "experiments/verify/leg_angles.h"

namespace halfstep::verify {

/// The robot at an instant of a walk, its waist upright and its soles level.
struct RobotPosture {
  Eigen::Isometry3d X_WB;        ///< the waist's pose
  std::array<Vector6d, 2> q;     ///< [rad]; nan where a leg does not reach
  std::array<LegPlace, 2> legs;  ///< mean nothing where it does not
  bool reached = true;           ///< by both legs

  /// Pose of a leg's link, in W.
  Eigen::Isometry3d OfLink(size_t side, size_t link) const {
    return X_WB * legs[side].X_BLink[link];
  }
};
/// A leg reaches when forward kinematics puts its sole to where the walk has it. `near`, which may
/// be null: about the angles (AnglesOf), nan where they are not known.
RobotPosture PostureOf(const RobotModel& robot, const WalkNumbers& x,
                       const std::array<Vector6d, 2>* near = nullptr);

/// The postures −4 … 4 steps of time [s] away from an instant, while the walk's numbers go along
/// the parabola that they describe there; the fifth is that of the instant, near `near`.
std::array<RobotPosture, 9> PosturesAround(const RobotModel& robot, const WalkInstant& at,
                                           double step, const std::array<Vector6d, 2>& near);

}  // namespace halfstep::verify
