#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "experiments/survey/found_legs.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// The rotation R_LinkB of the waist frame in the frame of the waist's link: z from the feet to the
/// hips, y from the right hip to the left one, with all joints at zero. A direction that is within
/// a degree of an axis of the link is that axis.
Eigen::Matrix3d FindWaistRotation(const UrdfTree& urdf, const FoundLegs& legs);

/// The flat part on which a foot stands.
struct FoundSole {
  /// Sole frame in the frame of the foot's link, which the sixth joint moves: centre of the
  /// rectangle, x forward with all joints at zero, z up. No body of the foot reaches below it.
  Eigen::Isometry3d X_FootSole = Eigen::Isometry3d::Identity();
  Eigen::Vector2d size{0, 0};  ///< the largest rectangle along x and y in what touches [m].
  double tilt = 0.0;           ///< of the flat part against the floor, all joints at zero [rad].
  double depth = 0.0;          ///< from the foot's origin down to it [m].
};

/// Finds the sole of each foot, by Index(Side), as mirror images of each other in the xz plane of
/// B: the largest flat part of the foot's bodies that faces down within 60°, and in it all that is
/// less than 1 mm above the lowest point. `legs` are at zero, in the waist frame; `bodies` are
/// those of BuildBodies. Throws std::runtime_error with a sentence when a foot has no bodies or
/// nothing flat.
std::array<FoundSole, 2> FindSoles(const std::array<Leg, 2>& legs,
                                   const std::vector<RobotBody>& bodies);

}  // namespace halfstep
