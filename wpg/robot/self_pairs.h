#pragma once

#include <array>
#include <vector>

#include "wpg/robot/robot_bodies.h"
#include "wpg/robot/robot_fields.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// Every two bodies of a robot that move against each other while walking, once: watched, or not.
/// Bodies of one link, and all bodies that are rigid with the waist, do not move against each other
/// and are in neither list.
struct SelfPairs {
  std::vector<std::array<int, 2>> watched;
  std::vector<UnwatchedPair> unwatched;
};

/// Not watched are bodies that are joined by design, and those of links that the robot file
/// excludes. Joined are links with one moving joint between them, and links with two joints of one
/// leg between them whose axes meet in one point (hip or ankle): their bodies lie around that point
/// and overlap.
SelfPairs BuildSelfPairs(const UrdfTree& urdf, const std::vector<ExcludedPair>& excluded,
                         const LinkBodies& all,
                         const std::array<std::array<int, 6>, 2>& leg_joints);

}  // namespace halfstep
