#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "wpg/robot/robot_model.h"

namespace halfstep {

/// What a foot stands on.
struct FoundSole {
  /// Sole frame in the frame of the foot's link, which the sixth joint moves: centre of the
  /// rectangle, x forward with all joints at zero, z up. No body of the foot reaches below it.
  Eigen::Isometry3d X_FootSole = Eigen::Isometry3d::Identity();
  Eigen::Vector2d size{0, 0};  ///< the largest rectangle along x and y in what touches [m].
  double tilt = 0.0;           ///< of its plane against the floor, all joints at zero [rad].
  double depth = 0.0;          ///< from the foot's origin down to it [m].
  std::string what;            ///< how it was found, for people
};

/// Soles that the user knows.
struct StatedSoles {
  Eigen::Vector2d size{0, 0};  ///< length and width of either [m]
  /// The left one's centre ahead of the foot's origin and outwards of it, all joints at zero [m];
  /// none: below the middle of what touches.
  std::optional<Eigen::Vector2d> centre;
};

/// Finds the sole of each foot, by Index(Side): the largest rectangle in all that is less than 1 mm
/// above the foot's lowest point, seen along the direction in which the largest flat part of its
/// bodies faces, within 60° of down; or, where nothing is flat, along that direction through three
/// of its balls, edges or points, and in what is less than 0.2 mm above these, which gives the
/// largest rectangle. `legs` are at zero, in the
/// waist frame; `bodies` are those of BuildBodies. Throws std::runtime_error with a sentence when a
/// foot has no bodies or no such rectangle, unless it is `stated`.
std::array<FoundSole, 2> FindSoles(const std::array<Leg, 2>& legs,
                                   const std::vector<RobotBody>& bodies,
                                   const std::optional<StatedSoles>& stated = {});

}  // namespace halfstep
