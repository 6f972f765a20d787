#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "planner/scene/scene.h"

namespace halfstep {

/// Sentences about obstacles that are hard to believe beside a robot of a height [m] whose walk
/// lies in a box of the floor [m]: larger than 20 times, or farther from the walk than 20 times,
/// the robot's height and the walk's extent together; smaller than 1/500 of the height in every
/// direction; or with points faster than ten times √(g·height). Most often a file is in other units
/// than metres, or a mesh turns about an origin that is far from it. Of each kind the worst one is
/// named, with how many others there are. Precondition: height > 0, a box that is not empty
/// (std::logic_error).
std::vector<std::string> DoubtfulObstacles(const Scene& scene, double height,
                                           const Eigen::AlignedBox2d& walk);

}  // namespace halfstep
