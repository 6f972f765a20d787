#pragma once

#include <array>
#include <vector>

#include "wpg/robot/robot_bodies.h"
#include "wpg/robot/robot_fields.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// Every pair of a robot's bodies that move relative to each other while walking, once, in one of
/// two lists: watched or not. Bodies of one link, and all bodies that are rigid with the waist, do
/// not move relative to each other and are in neither list.
struct SelfPairs {
  std::vector<std::array<int, 2>> watched;  ///< indices of RobotModel::bodies
  std::vector<UnwatchedPair> unwatched;     ///< with the reason why not
};

/// The moving joints (URDF indices) on the way between two links.
std::vector<int> JointsBetween(const UrdfTree& urdf, int a, int b);

/// Pairs of bodies that are joined by design, or whose links the robot file excludes, are not
/// watched. Joined are links with one moving joint between them, and links with two joints of one
/// leg between them whose axes meet in one point (hip or ankle), because their bodies lie around
/// that point and overlap.
SelfPairs BuildSelfPairs(const UrdfTree& urdf, const std::vector<ExcludedPair>& excluded,
                         const LinkBodies& all, const std::array<std::array<int, 6>, 2>& leg_joints,
                         const std::array<Leg, 2>& legs);

}  // namespace halfstep
