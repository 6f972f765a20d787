#include "experiments/survey/climbed_stairs.h"

#include <memory>
#include <numbers>

#include "experiments/config/experiment.h"
#include "experiments/run/half_step_table.h"
#include "experiments/run/planning.h"
#include "planner/ground/level_ground.h"
#include "planner/ground/stairs.h"
#include "wpg/robot/robot_measures.h"

namespace halfstep {
namespace {

constexpr double kUnit = 0.005;    // of a riser for HRP-2's size [m]
constexpr double kHighest = 0.35;  // of the leg's length: beyond what is tried

}  // namespace

Scene SceneOf(const Flight& flight, bool up) {
  const double middle = (up ? 0.5 : flight.treads - 0.5) * flight.run;
  const Stairs stairs{.X_WA = {middle, 0.0, up ? 0.0 : std::numbers::pi},
                      .rise = flight.rise,
                      .run = flight.run,
                      .width = kFlightWidth,
                      .count = flight.treads};
  Scene scene;
  scene.name = "flight";
  scene.ground = std::make_shared<const LevelGround>(TreadsOf("flight", stairs, 0.0), true);
  return scene;
}

HalfStepSequence WalkAlong(const Flight& flight, bool up, const RobotModel& robot,
                           const HalfStep& half_step) {
  const double y = 0.5 * robot.standing_width;
  const auto at = [&](int tread, Side side) {
    const int level = up ? tread : flight.treads - tread;
    return Foothold({tread * flight.run, Sign(side) * y, 0.0},
                    WholeNanometres(level * flight.rise));
  };
  std::vector<Footstep> footsteps;
  for (int i = 1; i <= flight.treads + 1; ++i) {
    const Side side = i % 2 == 1 ? Side::kRight : Side::kLeft;
    footsteps.push_back({.side = side,
                         .X_WF = at(std::min(i, flight.treads), side),
                         .via_height = half_step.via_height,
                         .duration = half_step.duration});
  }
  return MakeSequence({at(0, Side::kLeft), at(0, Side::kRight)}, footsteps, half_step.via_lateral,
                      half_step.shape, MotionModelOf(robot, half_step.shape));
}

double UsualRun(const RobotModel& robot) { return 1.3 * robot.sole_size.x(); }

double LeastRise(const RobotModel& robot) { return WholeNanometres(kUnit * SizeOf(robot)); }

std::optional<HalfStepConfig> FormFor(const Flight& flight, const RobotModel& robot,
                                      const ExperimentConfig& config, const GoesOn& goes_on) {
  const auto test_on = [&](bool up) {
    return CertifiedFeasibility(
        MarginEvaluator(robot, SceneOf(flight, up), config.smoothing.limits),
        config.smoothing.certification);
  };
  const CertifiedFeasibility upwards = test_on(true), downwards = test_on(false);
  for (const HalfStepConfig& form : HalfStepTable(config.half_step, flight.rise, SizeOf(robot))) {
    if (!goes_on()) return std::nullopt;
    if (form.via_height <= flight.rise) continue;
    ExperimentConfig with = config;
    with.half_step = form;
    const auto walks = [&](const CertifiedFeasibility& test, bool up) {
      return CertifyPlan(test, WalkAlong(flight, up, robot, PrototypeOf(with))).accepted;
    };
    if (walks(upwards, true) && walks(downwards, false)) return form;
  }
  return std::nullopt;
}

std::optional<ClimbedStairs> HighestStairs(double run, const RobotModel& robot,
                                           const ExperimentConfig& config, const GoesOn& goes_on) {
  const double unit = LeastRise(robot);
  std::optional<ClimbedStairs> highest;
  int over = 0, beyond = static_cast<int>(kHighest * LegLengthOf(robot) / unit);
  while (beyond - over > 1 && goes_on()) {
    const int middle = (over + beyond) / 2;
    const Flight flight{.rise = middle * unit, .run = run};
    const std::optional<HalfStepConfig> form = FormFor(flight, robot, config, goes_on);
    (form ? over : beyond) = middle;
    if (form) highest = {flight, *form};
  }
  return highest;
}

}  // namespace halfstep
