// What planners are told by certificates: free is certified, and lands where the ground bears.

#include <gtest/gtest.h>

#include <cmath>

#include "experiments/run/certificate_query.h"
#include "experiments/run/certified_half_steps.h"
#include "experiments/run/half_step_forms.h"
#include "experiments/run/half_step_table.h"
#include "planner/search/plan_shortcut.h"
#include "tests/temporary_folder.h"

namespace halfstep {
namespace {

// HRP-2 before three treads of 28 cm.
struct BeforeStairs {
  explicit BeforeStairs(double rise, double riser_at = 0.14) {
    WriteText(folder / "stairs.yaml",
              "surfaces:\n  - name: flight\n    stairs: {at: {x_m: " + std::to_string(riser_at) +
                  "}, rise_m: " + std::to_string(rise) + ", run_m: 0.28, width_m: 2, count: 3}\n");
    config = LoadConfig(WriteText(folder / "walk.yaml",
                                  "robot: hrp2\nscene: stairs.yaml\n"
                                  "goal: {x_m: 0.84, y_m: 0, radius_m: 0.1}\n"
                                  "planner: {workspace_m: [-0.4, -0.6, 1.2, 0.6]}\n"),
                        {});
    place.emplace(LoadPlace(config));
  }
  MarginEvaluator Evaluator() const {
    return MarginEvaluator(place->robot, place->scene, config.smoothing.limits);
  }
  TemporaryFolder folder;
  ExperimentConfig config;
  std::optional<Place> place;
};

// A form of half-steps that leads up treads of 10 cm.
void LiftHigher(ExperimentConfig* config) {
  config->half_step.via_height = 0.12;
  config->half_step.foot_delay = 0.15;
  config->half_step.lift_share = 0.6;
  config->half_step.rise_end = 0.85;
  config->half_step.crouch = 0.01;
}

StepSet SetOf(const ExperimentConfig& config) {
  StepSet set{.prototype = PrototypeOf(config), .placements = {}, .on_levels = true};
  for (const double x : {0.25, 0.28, 0.3}) {
    for (const double y : {-0.17, -0.2, -0.45})
      set.placements.push_back(Foothold::Level({x, y, 0.0}));
  }
  return set;
}

TEST(CertificateQuery, WhatIsFreeIsCertified) {
  BeforeStairs stairs(0.1);
  LiftHigher(&stairs.config);
  const StepSet set = SetOf(stairs.config);
  const CertificateQuery query(set, stairs.Evaluator(), stairs.config.smoothing.certification);
  const HalfStepCertifier certifier(stairs.place->robot, stairs.place->scene, stairs.config);
  std::mt19937_64 random(3);
  int free = 0, refused = 0;
  for (int k = 0; k < 60; ++k) {
    const Pose2 X_WS{0.28 * Pick(3, random) + Uniform(-0.02, 0.02, random),
                     Uniform(-0.3, 0.3, random), 0.0};
    const Foothold stands(X_WS, query.HeightAt(X_WS, 0.1));
    if (!query.Bears(stands)) continue;
    const int i = Pick(set.size(), random);
    const Side support = Pick(2, random) == 0 ? Side::kLeft : Side::kRight;
    const Pose2 X_WF = (stands * set.Placement(i, support)).Planar();
    const double height = query.HeightAt(X_WF, stands.height);
    HalfStep down = set.Down(i, support), up = set.Up(i, support);
    down.X_SF.height = height - stands.height;
    up.X_SF.height = stands.height - height;
    const bool down_is_free = query.DownIsFree(i, support, stands);
    const bool up_is_free = query.UpIsFree(i, support, stands);
    if (!std::isfinite(height)) {
      EXPECT_FALSE(down_is_free || up_is_free);
      continue;
    }
    EXPECT_EQ(down_is_free, certifier.Certifies(down, stands)) << k;
    EXPECT_EQ(up_is_free, certifier.Certifies(up, {X_WF, height})) << k;
    (down_is_free && up_is_free ? free : refused) += 1;
    EXPECT_EQ(query.DownIsFree(i, support, stands), down_is_free);  // as remembered
  }
  EXPECT_GE(free, 5);
  EXPECT_GE(refused, 1);
}

// Where intervals may not be bisected nothing is decided, though no instant speaks against it.
TEST(CertificateQuery, WhatIsNotProvedIsNotFree) {
  BeforeStairs stairs(0.1);
  LiftHigher(&stairs.config);
  const StepSet set = SetOf(stairs.config);
  const Foothold X_WS({-0.6, 0.0, 0.0}, 0.0);
  const CertificateQuery fine(set, stairs.Evaluator(), stairs.config.smoothing.certification);
  EXPECT_TRUE(fine.DownIsFree(1, Side::kLeft, X_WS));
  const CertificateQuery coarse(set, stairs.Evaluator(), {.resolution = 10.0, .longest = 10.0});
  EXPECT_FALSE(coarse.DownIsFree(1, Side::kLeft, X_WS));
}

// A place is beside the left sole, and across the right one.
TEST(CertificateQuery, IsRememberedBySupport) {
  BeforeStairs stairs(0.1);
  LiftHigher(&stairs.config);
  StepSet set = SetOf(stairs.config);
  set.placements = {Foothold::Level({0.25, -0.2, 0.0}), Foothold::Level({0.25, 0.2, 0.0})};
  const Foothold X_WS({-0.6, 0.0, 0.0}, 0.0);
  ASSERT_EQ(set.Placement(0, Side::kLeft), set.Placement(1, Side::kRight));
  const CertificateQuery query(set, stairs.Evaluator(), stairs.config.smoothing.certification);
  EXPECT_TRUE(query.DownIsFree(0, Side::kLeft, X_WS));
  EXPECT_FALSE(query.DownIsFree(1, Side::kRight, X_WS));
}

TEST(CertificateQuery, AFootOverAnEdgeIsNotBorne) {
  const BeforeStairs stairs(0.1);
  const StepSet set = SetOf(stairs.config);
  const CertificateQuery query(set, stairs.Evaluator(), stairs.config.smoothing.certification);
  EXPECT_EQ(query.HeightAt({0.28, 0.0, 0.0}, 0.0), 0.1);
  EXPECT_EQ(query.HeightAt({0.28, 0.0, 0.0}, 0.2), 0.1);
  EXPECT_TRUE(std::isnan(query.HeightAt({0.14, 0.0, 0.0}, 0.0)));
  EXPECT_TRUE(std::isnan(query.HeightAt({0.28, 0.0, 0.3}, 0.0)));   // turned over it
  EXPECT_TRUE(std::isnan(query.HeightAt({0.28, 0.0, 0.0}, -1.0)));  // out of reach
}

TEST(HalfStepForms, CrouchForStairsAndNameWhatIsTooHigh) {
  const BeforeStairs low(0.1), high(0.24);
  const HalfStepForms forms = FormsFor(low.config, *low.place, 3);
  ASSERT_FALSE(forms.forms.empty());
  EXPECT_TRUE(forms.too_high.empty());
  EXPECT_GT(forms.forms.front().crouch, 0.0);
  EXPECT_FALSE(Differences(forms.forms.front(), low.config.half_step).empty());
  // Who wants fewer gets the first of them.
  const HalfStepForms first = FormsFor(low.config, *low.place, 1);
  ASSERT_EQ(first.forms.size(), 1u);
  EXPECT_EQ(Differences(first.forms.front(), forms.forms.front()), "");
  const HalfStepForms none = FormsFor(high.config, *high.place, 3);
  ASSERT_FALSE(none.too_high.empty());
  EXPECT_EQ(none.too_high.front().find("no half-step that was tried leads "), 0u);
}

}  // namespace
}  // namespace halfstep
