#include "smoothing/margins/demandable.h"

#include "smoothing/margins/family_traits.h"
#include "wpg/nth.h"

namespace halfstep {

std::string WhyNotDemandable(MarginFamily family, const RobotModel& robot) {
  return Traits(family).coverage.why_not_demandable(robot);
}

std::array<double, kNumMarginFamilies> RaisedBy(const Tube& tube, const RobotModel& robot) {
  std::array<double, kNumMarginFamilies> raised{};
  if (tube == Tube{}) return raised;
  const TubeShift shift(robot, tube);
  for (const MarginFamily family : AllMarginFamilies()) {
    if (const TubeShare in_tube = Traits(family).in_tube) Nth(raised, family) = in_tube(shift);
  }
  return raised;
}

MarginLimits Demandable(MarginLimits limits, const RobotModel& robot) {
  limits.raised = RaisedBy(limits.tube, robot);
  for (const MarginFamily family : AllMarginFamilies()) {
    if (!WhyNotDemandable(family, robot).empty()) limits.demanded_of(family) = kNotDemanded;
  }
  return limits;
}

}  // namespace halfstep
