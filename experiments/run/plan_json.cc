#include "experiments/run/plan_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/tables/not_covered_json.h"

namespace halfstep {
namespace {

nlohmann::ordered_json PlacesJson(const PlannedWalk& walk) {
  auto places = nlohmann::ordered_json::array();
  for (const Footstep& footstep : walk.plan.footsteps) {
    const Foothold& at = footstep.X_WF;
    places.push_back(
        {{"foot", Name(footstep.side)}, {"x_m", at.x}, {"y_m", at.y}, {"yaw_rad", at.yaw}});
    if (walk.on_levels) places.back()["z_m"] = at.height;
    if (footstep.crouch) {
      places.back()["via_height_m"] = footstep.via_height;
      places.back()["crouch_m"] = *footstep.crouch;
    }
    if (!walk.in_time) continue;
    places.back()["rest_s"] = footstep.rest;
    places.back()["rest_on_one_foot_s"] = footstep.rest_on_one_foot;
  }
  return places;
}

}  // namespace

std::string PlanJson(const PlannedWalk& walk) {
  const PlanResult& plan = walk.plan;
  const GoalConfig& goal = walk.config.goal;
  const auto number = [](double x) {
    return std::isfinite(x) ? nlohmann::ordered_json(x) : nlohmann::ordered_json(nullptr);
  };
  nlohmann::ordered_json json = {
      {"planner", walk.config.planner.name},
      {"seed", walk.config.seed},
      {"status", Name(plan.status)},
      {"message", plan.sentence + (walk.detour.empty() ? "" : "; " + walk.detour)},
      {"goal",
       {{"part", goal.part},
        {"x_m", goal.X_WG.x},
        {"y_m", goal.X_WG.y},
        {"yaw_rad", goal.X_WG.yaw},
        {"radius_m", goal.radius},
        {"box_m", goal.box},
        {"yaw_tolerance_rad", goal.yaw_tolerance ? nlohmann::ordered_json(*goal.yaw_tolerance)
                                                 : nlohmann::ordered_json(nullptr)}}},
      {"cost_kind", walk.config.planner.CostName(walk.in_time)},
      {"cost", number(plan.cost)},
      {"footsteps", plan.footsteps.size()},
      {"places", PlacesJson(walk)},
      {"elements", plan.elements},
      {"nodes", plan.nodes},
      {"queries", plan.queries},
      {"effort", plan.effort() + walk.proof_effort},
      {"refusals", plan.refusals},
      {"half_steps", walk.half_steps.size},
      {"baked", walk.half_steps.cached.baked},
      {"time_to_first_s", number(plan.time_to_first)},
      {"plan_wall_s", number(plan.time)},
      {"set_wall_s", walk.half_steps.set_wall},
      {"volumes_wall_s", walk.half_steps.wall},
      {"not_covered", NotCoveredJson(walk.not_covered)}};
  if (!walk.inputs.empty()) json["inputs"] = walk.inputs;
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace halfstep
