#pragma once

#include <Eigen/Geometry>

namespace halfstep {

struct RobotModel;

/// The box along the axes that holds all bodies of a robot in its standing posture [m]: x ahead,
/// y to the left, both from the waist's origin, and z from the floor.
Eigen::AlignedBox3d StandingBounds(const RobotModel& robot);

}  // namespace halfstep
