#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "wpg/elementary.h"

namespace halfstep {

/// R of a turn in the plane by `angle` [rad].
inline Eigen::Matrix2d PlaneRotation(double angle) {
  const auto [s, c] = SinCos(angle);
  return Eigen::Matrix2d{{c, -s}, {s, c}};
}

/// R of a turn by `angle` [rad] about the unit `axis` (Rodrigues), as Eigen::AngleAxisd has it but
/// by functions that are the same on every machine.
inline Eigen::Matrix3d AxisRotation(double angle, const Eigen::Vector3d& axis) {
  const auto [s, c] = SinCos(angle);
  const Eigen::Vector3d to_side = s * axis, ahead = (1.0 - c) * axis;
  Eigen::Matrix3d R = ahead * axis.transpose();
  R.diagonal().array() += c;
  R(0, 1) -= to_side.z();
  R(1, 0) += to_side.z();
  R(0, 2) += to_side.y();
  R(2, 0) -= to_side.y();
  R(1, 2) -= to_side.x();
  R(2, 1) += to_side.x();
  return R;
}

/// Rz(yaw)·Ry(pitch)·Rx(roll) of angles [rad]: turns about the fixed axes, roll first.
inline Eigen::Matrix3d RollPitchYaw(double roll, double pitch, double yaw) {
  return AxisRotation(yaw, Eigen::Vector3d::UnitZ()) *
         AxisRotation(pitch, Eigen::Vector3d::UnitY()) *
         AxisRotation(roll, Eigen::Vector3d::UnitX());
}

/// The angle [rad] in [0, π] by which R turns.
inline double AngleOf(const Eigen::Matrix3d& R) {
  const Eigen::Quaterniond q(R);
  return 2.0 * Atan2(q.vec().norm(), std::abs(q.w()));
}

}  // namespace halfstep
