#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "planner/scene/scene.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// Sentences about obstacles that rest and look like ramps, since soles stand on level surfaces
/// only: of what faces up or down within 60° three tenths or more slope alike, by 2° to 30°, on no
/// less area than a sole has, and begin no more than 0.15 of the leg's length above a level or
/// below it. Only those of which something lies in `area` (W), at most three.
std::vector<std::string> SlopingTops(const RobotModel& robot, const Scene& scene,
                                     const Eigen::AlignedBox2d& area);

}  // namespace halfstep
