// Where no half-step of the set leads over what is in the way: half-steps of another form do, by
// their proofs, or the plan says what they miss.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/config/experiment.h"
#include "experiments/run/certified_half_steps.h"
#include "experiments/run/crossing_query.h"
#include "experiments/run/ground_steps.h"
#include "experiments/run/half_step_forms.h"
#include "experiments/run/planning.h"
#include "planner/search/plan_shortcut.h"
#include "tests/temporary_folder.h"

namespace halfstep {
namespace {

using testing::HasSubstr;

// HRP-2 before a thin plate of 3 m that it cannot walk around, with three places of its feet.
struct BeforePlate {
  explicit BeforePlate(double height) {
    const std::string z = std::to_string(height);
    WriteText(folder / "plate.yaml", "obstacles: [{name: plate, box: {size_m: [0.002, 3, " + z +
                                         "]}, pose: {xyz: [0.28, 0, " +
                                         std::to_string(0.5 * height) + "]}}]\n");
    config = LoadConfig(
        WriteText(folder / "walk.yaml",
                  "robot: hrp2\nscene: plate.yaml\ngoal: {x_m: 0.5, y_m: 0, radius_m: 0.14}\n"
                  "step_set: {x_min_m: 0, x_max_m: 0.28, y_min_m: -0.27, y_max_m: -0.27,\n"
                  "           spacing_m: 0.14, yaws_rad: [0]}\n"
                  "swept_volumes: {cell_m: 0.01, displacement_m: 0.01, cache: cache}\n"
                  "planner: {unimproved_nodes: 0, workspace_m: [-0.5, -0.6, 1.5, 0.6]}\n"
                  "smoothing: {methods: []}\n"),
        {});
    place.emplace(LoadPlace(config));
  }
  TemporaryFolder folder;
  ExperimentConfig config;
  std::optional<Place> place;
};

TEST(PlanOver, AnotherFormLeadsOverAPlateThatTheSetCannotCross) {
  const BeforePlate before(0.12);
  const PlannedWalk walk = PlanWalk(before.config, *before.place, {});
  ASSERT_EQ(walk.plan.status, PlanStatus::kSolved) << walk.plan.sentence;
  EXPECT_THAT(walk.plan.sentence, HasSubstr(", over 'plate' with half_step: {via_height_m: 0.1"));
  EXPECT_LE(walk.plan.footsteps.size(), 8u);
  EXPECT_GT(walk.proof_effort, 0.0);
  EXPECT_EQ(walk.detour, "");
  // What is handed on says all of it: the walk is certified as the config has it.
  const Experiment again = Prepare(walk.config);
  const CertifiedFeasibility test(
      MarginEvaluator(again.robot, again.scene, walk.config.smoothing.limits),
      walk.config.smoothing.certification);
  EXPECT_TRUE(CertifyPlan(test, again.sequence).accepted);
}

TEST(PlanOver, APlateThatIsTooHighIsToldWithWhatTheNearestFormMisses) {
  const BeforePlate before(0.27);
  const PlannedWalk walk = PlanWalk(before.config, *before.place, {});
  EXPECT_NE(walk.plan.status, PlanStatus::kSolved) << walk.plan.sentence;
  EXPECT_THAT(walk.plan.sentence,
              HasSubstr("meet 'plate', which is 0.27 m high where feet rise to"));
  EXPECT_THAT(walk.plan.sentence, HasSubstr("; no other half-step that was tried leads over it: "));
  EXPECT_EQ(walk.changed_half_step, "");
}

// Volumes that are too large for anything.
class NothingIsFree : public HalfStepQuery {
 public:
  bool DownIsFree(int, Side, const Foothold&) const override { return false; }
  bool UpIsFree(int, Side, const Foothold&) const override { return false; }
};

TEST(CrossingQuery, WhatIsFreeIsCertifiedAndLeadsOver) {
  BeforePlate before(0.12);
  const Obstacle& plate = before.place->scene.obstacles.front();
  const RobotModel& robot = before.place->robot;
  const FormOver found =
      FindFormOver(before.config, robot, plate, PlacesOf(before.config.step_set));
  ASSERT_TRUE(found.form) << found.missed;
  EXPECT_FALSE(found.landings.empty());
  EXPECT_GT(found.effort, 0.0);
  before.config.half_step = *found.form;
  const StepSet set = CertifiedHalfSteps(robot, before.config);
  const MarginEvaluator evaluator(robot, before.place->scene, before.config.smoothing.limits);
  const CertificateQuery proofs(set, evaluator, before.config.smoothing.certification,
                                {MarginFamily::kClearance, MarginFamily::kNoStep});
  const NothingIsFree volumes;
  const CrossingQuery query(volumes, proofs, set, robot.sole_outline, {FootprintOf(plate)});
  const HalfStepCertifier certifier(evaluator, before.config.smoothing.certification);
  std::mt19937_64 random(5);
  int free = 0, off = 0;
  for (int k = 0; k < 100; ++k) {
    const Foothold X_WS =
        Foothold::Level({Uniform(0.11, 0.17, random), Uniform(-0.3, 0.3, random), 0.0});
    const int i = Pick(set.size(), random);
    const Side support = Pick(2, random) == 0 ? Side::kLeft : Side::kRight;
    const Foothold X_WF = X_WS * set.Placement(i, support);
    const auto is_certified = [&](const Foothold& at) {
      return certifier.Certifies(set.Down(i, support), at);
    };
    if (query.DownIsFree(i, support, X_WS)) {
      ++free;
      EXPECT_TRUE(is_certified(X_WS));
      EXPECT_LT(X_WS.x, 0.28);
      EXPECT_GT(X_WF.x, 0.28);
      off += !is_certified(X_WS * Foothold::Level({0.05, 0.0, 0.0}));  // a control
    }
    if (query.UpIsFree(i, support, X_WS)) {
      ++free;
      EXPECT_TRUE(certifier.Certifies(set.Up(i, support), X_WF));
    }
  }
  EXPECT_GT(free, 5);
  EXPECT_GT(off, 0);
}

}  // namespace
}  // namespace halfstep
