#pragma once

#include <optional>
#include <span>
#include <string>

#include "smoothing/margins/margin.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// The families whose margins trajectory.csv has for a robot, in the order of its columns.
std::span<const MarginFamily> FamiliesOfTrajectory(const RobotModel& robot);
/// The column of a family there: "zmp_margin_m"; none: it has none for any robot.
std::optional<std::string> TrajectoryColumnOf(MarginFamily family);

}  // namespace halfstep
