#include "experiments/verify/config_plan.h"

namespace halfstep::verify {

HalfStep HalfStepOf(const HalfStepConfig& config) {
  HalfStep half_step;
  half_step.support_point = config.support_point;
  half_step.form = {.via_lateral = config.via_lateral,
                    .foot_ramp = config.foot_ramp,
                    .foot_delay = config.foot_delay,
                    .lift_share = config.lift_share,
                    .via_along = 0,
                    .zmp_shift = config.zmp_shift / config.duration,
                    .zmp_bump_ramp = config.zmp_bump_ramp.value_or(1)};
  return half_step;
}

std::array<Foothold, 2> StartSoles(const ExperimentConfig& config, const RobotModel& robot) {
  if (config.has_start) {
    return {Foothold::Level(config.start_left), Foothold::Level(config.start_right)};
  }
  const double aside = robot.standing_width / 2;
  return {Foothold::Level({0, aside, 0}), Foothold::Level({0, -aside, 0})};
}

WalkPlan PlanOf(const ExperimentConfig& config, const RobotModel& robot) {
  std::vector<PlannedFootstep> footsteps;
  for (const FootstepConfig& step : config.footsteps) {
    footsteps.push_back({.side = step.foot == "left" ? Side::kLeft : Side::kRight,
                         .X_WF = Foothold::Level(step.X_WF),
                         .via_height = step.via_height.value_or(config.half_step.via_height),
                         .duration = step.duration.value_or(config.half_step.duration)});
  }
  return PlanOf(StartSoles(config, robot), footsteps, HalfStepOf(config.half_step));
}

}  // namespace halfstep::verify
