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
                    .zmp_bump_ramp = config.zmp_bump_ramp.value_or(1),
                    .rise_begin = config.rise_begin,
                    .rise_end = config.rise_end};
  half_step.crouch = config.crouch;
  return half_step;
}

std::array<Pose2, 2> StartSoles(const ExperimentConfig& config, const RobotModel& robot) {
  if (config.has_start) return {config.start_left, config.start_right};
  const double aside = robot.standing_width / 2;
  return {Pose2{0, aside, 0}, Pose2{0, -aside, 0}};
}

std::optional<WalkPlan> PlanOf(const ExperimentConfig& config, const RobotModel& robot,
                               const LevelTops& ground, Findings* findings) {
  bool borne = true;
  const auto on_ground = [&](const Pose2& X_WF, const LevelChoice& on, const std::string& who) {
    if (ground.even()) return Foothold::Level(X_WF);
    const std::optional<double> only = on.name.empty() ? on.z : ground.HeightNamed(on.name);
    const auto height =
        on.name.empty() || only ? ground.HeightUnder(robot, X_WF, only) : std::nullopt;
    if (height) return Foothold(X_WF, *height);
    borne = false;
    findings->Disagree("config.yaml: " + who + ": no level of the scene bears all of the sole" +
                       Formatted(" at x = %.6g m, y = %.6g m", X_WF.x, X_WF.y));
    return Foothold::Level(X_WF);
  };
  const std::array<Pose2, 2> start = StartSoles(config, robot);
  const std::array<Foothold, 2> soles = {on_ground(start[0], config.start_left_on, "start.left"),
                                         on_ground(start[1], config.start_right_on, "start.right")};
  std::vector<PlannedFootstep> footsteps;
  for (const FootstepConfig& step : config.footsteps) {
    const std::string who = "footsteps[" + std::to_string(footsteps.size()) + "]";
    footsteps.push_back({.side = step.foot == "left" ? Side::kLeft : Side::kRight,
                         .X_WF = on_ground(step.X_WF, step.on, who),
                         .via_height = step.via_height.value_or(config.half_step.via_height),
                         .duration = step.duration.value_or(config.half_step.duration)});
  }
  if (!borne) return std::nullopt;
  return PlanOf(soles, footsteps, HalfStepOf(config.half_step));
}

}  // namespace halfstep::verify
