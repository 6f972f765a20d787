#include "experiments/tables/tube_json.h"

#include <nlohmann/json.hpp>

#include "smoothing/margins/family_traits.h"
#include "wpg/nth.h"

namespace halfstep {

nlohmann::ordered_json TubeJson(const MarginEvaluator& evaluator) {
  const MarginLimits& limits = evaluator.limits();
  const Tube& tube = limits.tube;
  const TubeShift shift(evaluator.robot(), tube);
  nlohmann::ordered_json raised = nlohmann::ordered_json::object();
  for (const MarginFamily family : evaluator.families()) {
    if (Traits(family).in_tube == nullptr) continue;
    raised[std::string(Name(family))] = Nth(limits.raised, family);
  }
  return {{"foot_m", tube.foot},
          {"foot_rad", tube.foot_turn},
          {"waist_m", tube.waist},
          {"waist_rad", tube.waist_turn},
          {"joint_rad", tube.joint},
          {"joint_speed_rad_s", tube.joint_speed},
          {"zmp_m", tube.zmp},
          {"raised", raised},
          {"taken", {{"clearance", shift.body}, {"self_clearance", shift.pair}}}};
}

}  // namespace halfstep
