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

namespace {

// The place of a sole on the ground; none, and that is told, where no level bears it.
std::optional<Foothold> OnGround(const Pose2& X_WF, const LevelChoice& on, const std::string& who,
                                 const RobotModel& robot, const LevelTops& ground,
                                 Findings* findings) {
  if (ground.even()) return Foothold::Level(X_WF);
  const std::optional<double> only = on.name.empty() ? on.z : ground.HeightNamed(on.name);
  const auto height =
      on.name.empty() || only ? ground.HeightUnder(robot, X_WF, only) : std::nullopt;
  if (height) return Foothold(X_WF, *height);
  findings->Disagree("config.yaml: " + who + ": no level of the scene bears all of the sole" +
                     Formatted(" at x = %.6g m, y = %.6g m", X_WF.x, X_WF.y));
  return std::nullopt;
}

}  // namespace

std::optional<std::array<Foothold, 2>> StartOn(const ExperimentConfig& config,
                                               const RobotModel& robot, const LevelTops& ground,
                                               Findings* findings) {
  const auto [left, right] = StartSoles(config, robot);
  const auto on_left = OnGround(left, config.start_left_on, "start.left", robot, ground, findings);
  const auto on_right =
      OnGround(right, config.start_right_on, "start.right", robot, ground, findings);
  if (!on_left || !on_right) return std::nullopt;
  return std::array{*on_left, *on_right};
}

std::optional<WalkPlan> PlanOf(const ExperimentConfig& config, const RobotModel& robot,
                               const LevelTops& ground, Findings* findings) {
  const auto soles = StartOn(config, robot, ground, findings);
  bool borne = soles.has_value();
  std::vector<PlannedFootstep> footsteps;
  for (const FootstepConfig& step : config.footsteps) {
    const std::string who = Formatted("footsteps[%td]", &step - config.footsteps.data());
    const auto X_WF = OnGround(step.X_WF, step.on, who, robot, ground, findings);
    borne = borne && X_WF.has_value();
    if (!X_WF) continue;
    footsteps.push_back({.side = step.foot == "left" ? Side::kLeft : Side::kRight,
                         .X_WF = *X_WF,
                         .via_height = step.via_height.value_or(config.half_step.via_height),
                         .duration = step.duration.value_or(config.half_step.duration),
                         .rest = step.rest.value_or(0),
                         .rest_on_one = step.rest_on_one_foot.value_or(0),
                         .crouch = step.crouch});
  }
  if (!borne) return std::nullopt;
  return PlanOf(*soles, footsteps, HalfStepOf(config.half_step));
}

}  // namespace halfstep::verify
