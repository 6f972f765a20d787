#pragma once

#include <Eigen/Geometry>

#include "wpg/geometry/rotation.h"

namespace halfstep::control {

/// The rotation by a rotation vector [rad].
inline Eigen::Matrix3d Turned(const Eigen::Vector3d& turn) {
  const double angle = turn.norm();
  return angle > 0.0 ? AxisRotation(angle, turn / angle) : Eigen::Matrix3d::Identity();
}

/// A turn by a rotation vector [rad] about a point [m].
inline Eigen::Isometry3d TurnedAbout(const Eigen::Vector3d& point, const Eigen::Vector3d& turn) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = Turned(turn);
  X.translation() = point - X.linear() * point;
  return X;
}

/// The rotation vector, to first order, of a small rotation [rad].
inline Eigen::Vector3d SmallTurnOf(const Eigen::Matrix3d& R) {
  return 0.5 * Eigen::Vector3d(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
}

}  // namespace halfstep::control
