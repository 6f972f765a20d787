#include "smoothing/margins/not_covered_by.h"

#include <string>

#include "smoothing/margins/demandable.h"
#include "smoothing/margins/family_traits.h"

namespace halfstep {
namespace {

bool HasNoLimit(MarginFamily family, const MarginLimits& limits) {
  return (family == MarginFamily::kFootSpeed && !limits.foot_speed) ||
         (family == MarginFamily::kFootYawRate && !limits.foot_yaw_rate);
}

}  // namespace

std::vector<NotCovered> NotCoveredBy(const RobotModel& robot, const Scene& scene,
                                     const MarginLimits& limits) {
  const MarginLimits demandable = Demandable(limits, robot);
  std::vector<NotCovered> list;
  for (const MarginFamily family : AllMarginFamilies()) {
    if (demandable.demanded_of(family) == kNotDemanded) {
      const std::string why = WhyNotDemandable(family, robot);
      list.push_back(NotDemandedFamily(Name(family), why.empty() ? "the config says none" : why));
    } else if (HasNoLimit(family, limits)) {
      list.push_back(UnlimitedFamily(Name(family)));
    }
  }
  if (demandable.demanded_of(MarginFamily::kFriction) != kNotDemanded &&
      scene.friction == Scene{}.friction) {
    list.push_back(AssumedFriction(scene.friction));
  }
  const std::vector<NotCovered> of_robot = NotCoveredOf(robot);
  list.insert(list.end(), of_robot.begin(), of_robot.end());
  return list;
}

}  // namespace halfstep
