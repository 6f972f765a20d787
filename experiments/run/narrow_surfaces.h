#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "wpg/ground/ground.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// Sentences about surfaces on which no sole of a robot stands as it comes: those that are narrower
/// than the sole, with `foothold` ≥ 0 [m] beside it, is long; and how far it has to be turned
/// there, or that it stands there in no direction. Surfaces of one level whose bounds touch are
/// looked at together. Only those of which something lies in `area` (W), the narrowest first, at
/// most three sentences.
///
/// What is said holds: a sole that stands is no wider in any direction than the convex hull of the
/// surfaces that bear it, and it is compared with that hull across each of its edges, direction by
/// direction, with a bound for those in between. What is not said need not be wide enough, since
/// obstacles and solids on a surface are not looked at.
std::vector<std::string> NarrowSurfaces(const RobotModel& robot, const Ground& ground,
                                        double foothold, const Eigen::AlignedBox2d& area);

}  // namespace halfstep
