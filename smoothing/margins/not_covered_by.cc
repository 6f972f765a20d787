#include "smoothing/margins/not_covered_by.h"

#include <string>

#include "smoothing/margins/demandable.h"
#include "smoothing/margins/family_traits.h"

namespace halfstep {

std::vector<NotCovered> NotCoveredBy(const RobotModel& robot, const Scene& scene,
                                     const MarginLimits& limits) {
  const MarginLimits demandable = Demandable(limits, robot);
  std::vector<NotCovered> list, assumed;
  for (const MarginFamily family : FamiliesWith(limits.own)) {
    const FamilyCoverage& coverage = Traits(family).coverage;
    if (demandable.demanded_of(family) == kNotDemanded) {
      const std::string why = WhyNotDemandable(family, robot);
      if (why.empty() && coverage.on_request) continue;
      list.push_back(NotDemandedFamily(Name(family), why.empty() ? "the config says none" : why));
      continue;
    }
    if (coverage.limit != nullptr && !(limits.*coverage.limit)) {
      if (coverage.on_request) continue;
      list.push_back(UnlimitedFamily(Name(family)));
    }
    if (const auto one = coverage.assumes(robot, scene)) assumed.push_back(*one);
  }
  list.insert(list.end(), assumed.begin(), assumed.end());
  const std::vector<NotCovered> of_robot = NotCoveredOf(robot);
  list.insert(list.end(), of_robot.begin(), of_robot.end());
  return list;
}

}  // namespace halfstep
