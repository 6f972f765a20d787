#include "smoothing/margins/demandable.h"

#include "smoothing/margins/family_traits.h"

namespace halfstep {

std::string WhyNotDemandable(MarginFamily family, const RobotModel& robot) {
  return Traits(family).coverage.why_not_demandable(robot);
}

MarginLimits Demandable(MarginLimits limits, const RobotModel& robot) {
  for (const MarginFamily family : AllMarginFamilies()) {
    if (!WhyNotDemandable(family, robot).empty()) limits.demanded_of(family) = kNotDemanded;
  }
  return limits;
}

}  // namespace halfstep
