#include "experiments/run/plan_yaml.h"

#include <vector>

#include "wpg/files/yaml_fields.h"
#include "wpg/nth.h"

namespace halfstep {

std::string PlanYaml(const PlannedWalk& walk) {
  std::string text;
  if (!walk.changed_half_step.empty()) text = "half_step: {" + walk.changed_half_step + "}\n";
  std::vector<FootstepConfig> footsteps = walk.config.footsteps;
  for (size_t i = 0; i < footsteps.size(); ++i) {
    Nth(footsteps, i).on.z = Nth(walk.plan.footsteps, i).X_WF.height;
  }
  return text + WriteYaml([&](Fields& fields) {
           fields.List("footsteps", {}, &footsteps, [&walk](Fields& f, FootstepConfig* step) {
             f.Text("foot", &step->foot, {});
             f.Number("x_m", &step->X_WF.x, {});
             f.Number("y_m", &step->X_WF.y, {});
             f.Number("yaw_deg", &step->X_WF.yaw, {});
             if (walk.on_levels) f.OptionalNumber("z_m", &step->on.z, {});
             f.OptionalNumber("via_height_m", &step->via_height, {.none_left_out = true});
             f.OptionalNumber("rest_s", &step->rest, {.none_left_out = true});
             f.OptionalNumber("rest_on_one_foot_s", &step->rest_on_one_foot,
                              {.none_left_out = true});
             f.OptionalNumber("crouch_m", &step->crouch, {.none_left_out = true});
           });
         });
}

}  // namespace halfstep
