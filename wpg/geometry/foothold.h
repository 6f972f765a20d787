#pragma once

#include <cmath>

#include "wpg/check.h"
#include "wpg/geometry/pose2.h"

namespace halfstep {

/// The place of a foot, X_AF: of its sole's centre, upright at a height. No planar pose becomes one
/// unasked, nor the reverse: whoever leaves the height out says why, by Planar or LevelPose.
struct Foothold {
  double x = 0.0;       ///< [m]
  double y = 0.0;       ///< [m]
  double height = 0.0;  ///< above the origin of A [m]
  double yaw = 0.0;     ///< [rad], not wrapped, as in Pose2

  Foothold() = default;
  /// Seen from above at `X_AF`, `z` above the origin of A [m].
  Foothold(const Pose2& X_AF, double z) : x(X_AF.x), y(X_AF.y), height(z), yaw(X_AF.yaw) {}
  /// Level with the origin of A: on the floor, where that is W.
  static Foothold Level(const Pose2& X_AF) { return {X_AF, 0.0}; }

  /// Seen from above: for what does not depend on heights.
  Pose2 Planar() const { return {x, y, yaw}; }
  /// The same for what knows one level only. Precondition: height is 0 (std::logic_error).
  Pose2 LevelPose() const {
    CheckLevel();
    return Planar();
  }
  /// Precondition of what knows one level only: height is 0 (std::logic_error).
  void CheckLevel() const { HALFSTEP_CHECK(height == 0.0, "height = " << height << " m"); }
  /// Whether no number is infinite or NaN.
  bool AllFinite() const { return Planar().AllFinite() && std::isfinite(height); }

  /// X_AC = X_AB · X_BC.
  Foothold operator*(const Foothold& X_BC) const {
    return {Planar() * X_BC.Planar(), height + X_BC.height};
  }
  /// X_BA.
  Foothold Inverse() const { return {Planar().Inverse(), 0.0 - height}; }
  /// Reflection in the xz plane: left becomes right.
  Foothold Mirrored() const { return {Planar().Mirrored(), height}; }

  friend bool operator==(const Foothold&, const Foothold&) = default;
};

/// X_AF in space.
inline Eigen::Isometry3d ToIsometry(const Foothold& X_AF) {
  return ToIsometry(X_AF.Planar(), X_AF.height);
}

}  // namespace halfstep
