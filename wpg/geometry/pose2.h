#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "wpg/elementary.h"
#include "wpg/geometry/rotation.h"

namespace halfstep {

/// Planar pose X_AB of frame B in frame A: position (x, y) [m] and yaw [rad] (not wrapped: yaw is a
/// real number, so that differences of yaw keep their number of turns).
struct Pose2 {
  double x = 0.0;    ///< [m]
  double y = 0.0;    ///< [m]
  double yaw = 0.0;  ///< [rad]

  /// Whether no number is infinite or NaN.
  bool AllFinite() const { return std::isfinite(x) && std::isfinite(y) && std::isfinite(yaw); }
  Eigen::Vector2d position() const { return {x, y}; }  ///< (x, y) [m]
  /// R_AB (2×2).
  Eigen::Matrix2d rotation() const { return PlaneRotation(yaw); }

  /// p_A = X_AB · p_B [m].
  Eigen::Vector2d operator*(const Eigen::Vector2d& p_B) const {
    const auto [s, c] = SinCos(yaw);
    return {x + c * p_B.x() - s * p_B.y(), y + s * p_B.x() + c * p_B.y()};
  }
  /// X_AC = X_AB · X_BC.
  Pose2 operator*(const Pose2& X_BC) const {
    const Eigen::Vector2d p = *this * X_BC.position();
    return {p.x(), p.y(), yaw + X_BC.yaw};
  }
  /// X_BA.
  Pose2 Inverse() const {
    const auto [s, c] = SinCos(yaw);
    return {-c * x - s * y, s * x - c * y, -yaw};
  }
  /// Reflection in the xz plane: left becomes right.
  Pose2 Mirrored() const { return {x, -y, -yaw}; }

  friend bool operator==(const Pose2&, const Pose2&) = default;
};

/// X_AB in space, at height z [m], upright.
inline Eigen::Isometry3d ToIsometry(const Pose2& X_AB, double z) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = AxisRotation(X_AB.yaw, Eigen::Vector3d::UnitZ());
  X.translation() = Eigen::Vector3d(X_AB.x, X_AB.y, z);
  return X;
}

}  // namespace halfstep
