#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/config/experiment.h"
#include "experiments/run/planning.h"
#include "tests/experiments/run_check.h"
#include "tests/temporary_folder.h"

namespace halfstep {
namespace {

using testing::HasSubstr;
using testing::Not;

// A plan with half-steps straight ahead, `longest` [m] at most, on coarse cells; `widest` [m] is
// where feet land at the side.
PlannedWalk PlanAmong(const TemporaryFolder& place, const std::string& scene,
                      const std::string& longest, const std::string& widest = "-0.21") {
  WriteText(place / "scene.yaml", scene);
  const std::string config =
      WriteText(place / "walk.yaml",
                "robot: hrp2\nscene: scene.yaml\ngoal: {x_m: 1, y_m: 0, radius_m: 0.15}\n"
                "step_set: {x_min_m: 0, x_max_m: " +
                    longest + ", y_min_m: " + widest +
                    ", y_max_m: -0.21,\n"
                    "           spacing_m: " +
                    longest +
                    ", yaws_rad: [0]}\n"
                    "swept_volumes: {cell_m: 0.03, displacement_m: 0.03, cache: cache}\n"
                    "planner: {unimproved_nodes: 0, workspace_m: [-0.5, -0.6, 1.5, 0.6]}\n"
                    "smoothing: {methods: []}\n");
  const ExperimentConfig read = LoadConfig(config, {});
  return PlanWalk(read, LoadPlace(read), {});
}

// Why there is none.
std::string SentenceOf(const TemporaryFolder& place, const std::string& scene,
                       const std::string& longest) {
  const PlannedWalk walk = PlanAmong(place, scene, longest);
  EXPECT_EQ(walk.plan.status, PlanStatus::kNoPlan) << walk.plan.sentence;
  return walk.plan.sentence;
}

std::string Bar(const std::string& depth, const std::string& height) {
  return "obstacles: [{name: bar, box: {size_m: [" + depth + ", 3, " + height +
         "]}, pose: {xyz: [0.6, 0, 0]}}]\n";
}

TEST(PlanWords, ABarThatNoHalfStepIsLongEnoughForIsNamedWithBothLengths) {
  const TemporaryFolder place;
  const std::string sentence = SentenceOf(place, Bar("0.02", "0.04"), "0.2");
  EXPECT_THAT(sentence, HasSubstr("all that the half-steps reach"));
  EXPECT_THAT(sentence, HasSubstr("; a foot came within "));
  EXPECT_THAT(sentence, HasSubstr(" half-steps refused nearest to the goal meet 'bar'; 'bar' is "
                                  "0.02 m high and 0.02 m deep: straight over it a half-step needs "
                                  "0.2"));
  EXPECT_THAT(sentence, HasSubstr(" m from sole to sole, the longest here has 0.2 m, and sideways "
                                  "none leads over it (longer ones: step_set, "
                                  "half_step.duration_s)"));
}

TEST(PlanWords, AWallIsTheRoomsMatterNotTheSets) {
  const TemporaryFolder place;
  const std::string sentence = SentenceOf(place, Bar("0.02", "1"), "0.2");
  EXPECT_THAT(sentence, HasSubstr("meet 'bar', which is 0.5 m high where feet rise to 0.25 m: a "
                                  "way leads past it or there is none"));
  EXPECT_THAT(sentence, Not(HasSubstr("over it a half-step needs")));
}

TEST(PlanWords, ADitchIsToldAsNoStepArea) {
  const TemporaryFolder place;
  EXPECT_THAT(SentenceOf(place,
                         "no_step: [{name: ditch, polygon_m: [[0.3, -3], [0.6, -3], [0.6, 3], "
                         "[0.3, 3]]}]\n",
                         "0.2"),
              HasSubstr(" half-steps refused nearest to the goal land on no-step areas"));
}

TEST(PlanWords, AWayAroundIsToldWithWhatNoHalfStepLeadsOver) {
  const TemporaryFolder place;
  const std::string bar = "obstacles: [{name: bar, box: {size_m: [0.02, 0.4, 0.04]}, pose: {xyz: ";
  const PlannedWalk around = PlanAmong(place, bar + "[0.5, 0.1, 0]}}]\n", "0.16", "-0.37");
  ASSERT_EQ(around.plan.status, PlanStatus::kSolved) << around.plan.sentence;
  EXPECT_THAT(around.detour, HasSubstr("'bar' is 0.02 m high and 0.02 m deep: straight over it"));
  const PlannedWalk past = PlanAmong(place, bar + "[0.5, 1.1, 0]}}]\n", "0.16", "-0.37");
  ASSERT_EQ(past.plan.status, PlanStatus::kSolved) << past.plan.sentence;
  EXPECT_EQ(past.detour, "");
  EXPECT_EQ(past.changed_half_step, "");
  EXPECT_EQ(past.proof_effort, 0.0);  // nothing else was tried
}

TEST(PlanWords, WhatMovesIsNamedWithTheTimeFromWhichItRests) {
  const TemporaryFolder place;
  const std::string sentence = SentenceOf(
      place,
      "obstacles: [{name: cart, box: {size_m: [0.3, 3, 0.8]}, pose: {xyz: [0.6, 4, 0.4]},\n"
      "             motion: {waypoints: [{t_s: 2, xyz: [0.6, 0, 0.4]}]}}]\n",
      "0.2");
  EXPECT_THAT(sentence, HasSubstr("; of "));
  EXPECT_THAT(sentence, HasSubstr(" half-steps near the goal that are not always free "));
  EXPECT_THAT(sentence, HasSubstr(" meet the way of 'cart', which rests from 2 s on"));
  EXPECT_THAT(sentence, Not(HasSubstr("half-steps refused nearest")));
}

TEST(PlanWords, TheKeyThatEndedTheSearchIsNamed) {
  const TemporaryFolder place;
  const std::string wall = Bar("0.02", "1");
  std::string sentence;
  WriteText(place / "scene.yaml", wall);
  const std::string begin = "planner: {unimproved_nodes: 0, ";
  for (const auto& [key, said] :
       {std::pair{"max_nodes: 3", "; `planner.max_nodes`, 3, ended it after an effort of "},
        {"effort: 0.001", "; `planner.effort`, 0.001, ended it after "}}) {
    const std::string config =
        WriteText(place / "walk.yaml",
                  "robot: hrp2\nscene: scene.yaml\ngoal: {x_m: 1, y_m: 0, radius_m: 0.15}\n"
                  "step_set: {x_min_m: 0, x_max_m: 0.2, y_min_m: -0.21, y_max_m: -0.21,\n"
                  "           spacing_m: 0.1, yaws_rad: [-0.25, 0, 0.25]}\n"
                  "swept_volumes: {cell_m: 0.05, displacement_m: 0.05, cache: cache}\n" +
                      begin + key + "}\nsmoothing: {methods: []}\n");
    const ExperimentConfig read = LoadConfig(config, {});
    const PlannedWalk walk = PlanWalk(read, LoadPlace(read), {});
    EXPECT_EQ(walk.plan.status, PlanStatus::kBudget) << walk.plan.sentence;
    EXPECT_THAT(walk.plan.sentence, HasSubstr(said));
  }
}

}  // namespace
}  // namespace halfstep
