#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <string>

namespace halfstep {

// What the readers of other programs' scenes share.

inline constexpr double kLeastSize = 1e-6;  ///< of a shape in a scene [m]
inline constexpr double kMostSize = 1000;   ///< the same

/// What is wrong with a size that is out of range.
std::string SizeMistake(double size);

/// What is wrong with a quaternion.
inline constexpr const char* kNoTurn = "no turn: its four numbers are not of length 1 (x y z w)";
/// What is wrong with a file of more than kMostThings things.
inline constexpr const char* kTooManyThings = "too many things (valid: at most 100,000)";
/// What is told of cones.
inline constexpr const char* kConesTold =
    "cones are meshes of 64 sides around them, wider by at most 0.13 % of their radius";

/// The pose of a position and a quaternion x y z w: of length 1 to a hundredth, which is made
/// exact, or all 0, which messages have for no turn. None: it is no turn.
std::optional<Eigen::Isometry3d> PoseOf(const Eigen::Vector3d& p, const Eigen::Vector4d& xyzw);

/// A plane a·x + b·y + c·z + d = 0.
struct PointAndNormal {
  Eigen::Vector3d normal;  ///< unit
  Eigen::Vector3d point;   ///< of the plane, nearest to the origin [m]
};
/// None: it has no normal.
std::optional<PointAndNormal> PlaneOf(const Eigen::Vector4d& abcd);

}  // namespace halfstep
