#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "wpg/geometry/foothold.h"
#include "wpg/geometry/side.h"

namespace halfstep {

/// Which part of a stance shall reach a goal. The middle of the feet has the mean of their
/// positions and of their yaws.
enum class GoalPart { kLeftFoot, kRightFoot, kEitherFoot, kMidFeet };

/// Where a walk may end: seen from above, a disc or a box, borders included, and optionally a range
/// of yaw.
struct GoalRegion {
  GoalPart part = GoalPart::kEitherFoot;  ///< what has to lie in it
  Pose2 X_WG;           ///< centre; its yaw turns the box and is the middle of the range of yaw
  double radius = 0.1;  ///< of the disc [m] ≥ 0; unused with a box
  std::optional<Eigen::Vector2d> box;        ///< full edge lengths along x and y of G [m] ≥ 0
  std::optional<double> yaw_tolerance = {};  ///< half the range [rad] ≥ 0; none: any yaw
  /// Height of the level on which the foot, or both feet whose middle counts, shall stand [m];
  /// none: on any.
  std::optional<double> height = {};

  /// Whether all values are finite and no size is negative.
  bool IsValid() const;
  /// Distance from a point of the floor to the region [m]: 0 inside.
  double Distance(const Eigen::Vector2d& p_W) const;
  /// How far a yaw is outside the range [rad], counted modulo 2π: 0 inside or without a range.
  double Turn(double yaw) const;
  /// Whether a foot stands at the height that is asked for.
  bool IsLevel(const Foothold& X_WF) const { return !height || X_WF.height == *height; }
  /// Whether a pose of the part that counts is in the region.
  bool Contains(const Pose2& X_W) const;
  /// Whether standing with the soles `feet`, by Index(Side), is a goal.
  bool ContainsStance(const std::array<Foothold, 2>& feet) const;
  /// The same for a foot `side` at X_WF that has just landed beside a support sole X_WS which was
  /// no goal already.
  bool ContainsLanding(Side side, const Foothold& X_WF, const Foothold& X_WS) const;
};

/// Middle of two soles seen from above: means of positions and of yaws.
Pose2 MidFeet(const Pose2& X_WL, const Pose2& X_WR);

}  // namespace halfstep
