#pragma once

#include "wpg/geometry/pose2.h"

namespace halfstep {

/// The place of a foot, X_AF: the planar pose of its sole's centre, and how high the ground is
/// there. All ground is level with the floor today: `height` is 0 wherever it is used.
struct Footprint : Pose2 {
  double height = 0.0;  ///< above the origin of A [m]

  Footprint() = default;
  /// X, y [m], yaw [rad] and z, the height [m].
  Footprint(double x, double y, double yaw, double z = 0.0) : Pose2{x, y, yaw}, height(z) {}
  /// On the floor.
  Footprint(const Pose2& X_AF) : Pose2(X_AF) {}  // NOLINT: every planar pose is a place

  using Pose2::operator*;
  /// X_AC = X_AB · X_BC.
  Footprint operator*(const Footprint& X_BC) const {
    const Pose2 X_AC = static_cast<const Pose2&>(*this) * static_cast<const Pose2&>(X_BC);
    return {X_AC.x, X_AC.y, X_AC.yaw, height + X_BC.height};
  }
  /// X_BA.
  Footprint Inverse() const {
    const Pose2 X_BA = Pose2::Inverse();
    return {X_BA.x, X_BA.y, X_BA.yaw, -height};
  }
  /// Reflection in the xz plane: left becomes right.
  Footprint Mirrored() const { return {x, -y, -yaw, height}; }

  friend bool operator==(const Footprint&, const Footprint&) = default;
  /// Whether a is on the floor at b.
  friend bool operator==(const Footprint& a, const Pose2& b) { return a == Footprint(b); }
};

}  // namespace halfstep
