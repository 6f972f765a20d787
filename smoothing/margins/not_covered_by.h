#pragma once

#include <vector>

#include "planner/scene/scene.h"
#include "smoothing/margins/margin.h"
#include "wpg/robot/not_covered.h"

namespace halfstep {

/// All that a certificate by these limits does not speak of, each with the reason: families, in
/// their order, of which nothing is demanded or that have no limit, but for those that a config has
/// to ask for and does not; a friction and accelerations of joints that are assumed; and what of
/// the robot no certificate covers (NotCoveredOf). The one list of every command, file and page
/// that shows a certificate.
std::vector<NotCovered> NotCoveredBy(const RobotModel& robot, const Scene& scene,
                                     const MarginLimits& limits);

}  // namespace halfstep
