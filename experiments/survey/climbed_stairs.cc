#include "experiments/survey/climbed_stairs.h"

#include <algorithm>
#include <memory>
#include <numbers>

#include "experiments/config/experiment.h"
#include "experiments/run/planning.h"
#include "planner/ground/level_ground.h"
#include "planner/ground/stairs.h"
#include "wpg/robot/robot_measures.h"

namespace halfstep {
namespace {

constexpr double kHrp2sLeg = 0.705;  // [m]
constexpr double kUnit = 0.005;      // of a riser for HRP-2's size [m]
constexpr double kHighest = 0.35;    // of the leg's length: beyond what is tried

double SizeOf(const RobotModel& robot) { return MeasuresOf(robot).leg_length / kHrp2sLeg; }

// What is tried, the usual first. Lengths for HRP-2's size; a via point lower than the next tread
// is left out.
std::vector<HalfStep> TriedForms(const Flight& flight, const RobotModel& robot,
                               const HalfStep& usual) {
  const double size = SizeOf(robot);
  std::vector<HalfStep> forms;
  for (const double slower : {1.0, 1.1}) {
    for (const double crouch : {0.0, 0.01, 0.02}) {
      for (const double delay : {0.13, 0.15, 0.18}) {
        for (const double lower : {0.0, 0.04}) {
          HalfStep form = usual;
          form.duration *= slower;
          form.via_height -= lower * size;
          form.shape.crouch = crouch * size;
          form.shape.foot_delay = std::max(delay, usual.shape.foot_delay);
          if (form.via_height > flight.rise + 0.02 * size) forms.push_back(form);
        }
      }
    }
  }
  return forms;
}

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

std::optional<HalfStep> FormFor(const Flight& flight, const RobotModel& robot,
                                const ExperimentConfig& config, const GoesOn& goes_on) {
  const auto test_on = [&](bool up) {
    return CertifiedFeasibility(
        MarginEvaluator(robot, SceneOf(flight, up), config.smoothing.limits),
        config.smoothing.certification);
  };
  const CertifiedFeasibility upwards = test_on(true), downwards = test_on(false);
  for (const HalfStep& form : TriedForms(flight, robot, PrototypeOf(config))) {
    if (!goes_on()) return std::nullopt;
    const auto walks = [&](const CertifiedFeasibility& test, bool up) {
      return CertifyPlan(test, WalkAlong(flight, up, robot, form)).accepted;
    };
    if (walks(upwards, true) && walks(downwards, false)) return form;
  }
  return std::nullopt;
}

std::optional<ClimbedStairs> HighestStairs(double run, const RobotModel& robot,
                                           const ExperimentConfig& config, const GoesOn& goes_on) {
  const double unit = WholeNanometres(kUnit * SizeOf(robot));
  std::optional<ClimbedStairs> highest;
  int over = 0, beyond = static_cast<int>(kHighest * MeasuresOf(robot).leg_length / unit);
  while (beyond - over > 1 && goes_on()) {
    const int middle = (over + beyond) / 2;
    const Flight flight{.rise = middle * unit, .run = run};
    const std::optional<HalfStep> form = FormFor(flight, robot, config, goes_on);
    (form ? over : beyond) = middle;
    if (form) highest = {flight, *form};
  }
  return highest;
}

}  // namespace halfstep
