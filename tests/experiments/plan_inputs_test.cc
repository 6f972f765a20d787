#include "experiments/run/plan_inputs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "experiments/commands/commands.h"
#include "experiments/run/missed_demands_text.h"
#include "smoothing/proof/missed_demands.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/run_check.h"
#include "tests/temporary_folder.h"

namespace halfstep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

// Walks of HRP-2 whose feet are 0.17 m apart.
class PlanInputsTest : public testing::Test {
 protected:
  std::string Write(const std::string& start, const std::string& footsteps,
                    const std::string& scene = "none") const {
    return WriteText(place_ / "walk.yaml", "robot: hrp2\nscene: " + scene + "\nstart: " + start +
                                               "\nfootsteps:\n" + footsteps +
                                               "smoothing: {methods: []}\n");
  }
  std::vector<std::string> Look(const std::string& config) const {
    const Experiment experiment = Prepare(LoadConfig(config, {}));
    return LookAtFootsteps(experiment, MarginEvaluator(experiment.robot, experiment.scene,
                                                       experiment.config.smoothing.limits));
  }
  // A scene with a plank, 2 cm high, whose side is 1 mm inside the right foot at (0.4, −0.085).
  std::string Plank() const {
    return WriteText(place_ / "plank.yaml",
                     "obstacles: [{name: plank, box: {size_m: [0.05, 0.1, 0.02]},\n"
                     "             pose: {xyz: [0.4, -0.203, 0.01]}}]\n");
  }

  const std::string start_ = "{left: {x_m: 0, y_m: 0.085}, right: {x_m: 0, y_m: -0.085}}";
  const std::string good_ =
      "  - {foot: left, x_m: 0.2, y_m: 0.085}\n"
      "  - {foot: right, x_m: 0.4, y_m: -0.085}\n"
      "  - {foot: left, x_m: 0.4, y_m: 0.085}\n";
  TemporaryFolder place_;
};

TEST_F(PlanInputsTest, SayNothingOfAWalkWithoutMistake) {
  EXPECT_THAT(Look(Write(start_, good_)), IsEmpty());
}

TEST_F(PlanInputsTest, TellThatLeftAndRightAreExchangedAtTheStart) {
  EXPECT_THAT(Look(Write("{left: {x_m: 0, y_m: -0.085}, right: {x_m: 0, y_m: 0.085}}", good_)),
              ElementsAre("start: the left foot is 0.17 m to the right of the right foot; left and "
                          "right look exchanged in `start`"));
}

TEST_F(PlanInputsTest, TellThatLeftAndRightAreExchangedInFootsteps) {
  const std::string swapped =
      "  - {foot: right, x_m: 0.2, y_m: 0.085}\n"
      "  - {foot: left, x_m: 0.4, y_m: -0.085}\n"
      "  - {foot: right, x_m: 0.4, y_m: 0.085}\n";
  EXPECT_THAT(Look(Write(start_, swapped)),
              ElementsAre("footstep 1 (right) is 0 m to the right of the left foot; left and right "
                          "look exchanged in `footsteps`"));
}

TEST_F(PlanInputsTest, TellThatPlacesLookLikeCentimetres) {
  const std::string far =
      "  - {foot: left, x_m: 20, y_m: 8.5}\n"
      "  - {foot: right, x_m: 40, y_m: -8.5}\n";
  const std::vector<std::string> lines = Look(Write(start_, far));
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_THAT(lines[0], StartsWith("footstep 1 (left) lands beside the right foot 21.8 m away, and "
                                   "the legs of hrp2 are 0.7 m long; in centimetres it would be "
                                   "0.218 m (x_m and y_m are in metres)"));
}

TEST_F(PlanInputsTest, TellATurnThatNoHipMakesAndAFootThatStepsTwice) {
  const std::string steps =
      "  - {foot: left, x_m: 0.2, y_m: 0.085}\n"
      "  - {foot: left, x_m: 0.2, y_m: 0.085, yaw_deg: 130}\n";
  const std::vector<std::string> lines = Look(Write(start_, steps));
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0],
            "footsteps 1 and 2 are both of the left foot: is one of the right foot missing in "
            "between?");
  EXPECT_THAT(lines[1], testing::MatchesRegex("footstep 2 .left. is turned by 130° against the "
                                              "right foot, and the hips of hrp2 turn by [0-9]+° "
                                              "each at most"));
}

// On the screen, in JSON, in the folder and before all symptoms.
TEST_F(PlanInputsTest, ComeFirstWhereThePlanIsNotFeasible) {
  Write("{left: {x_m: 0, y_m: -0.085}, right: {x_m: 0, y_m: 0.085}}", good_);
  const Outcome outcome = Halfstep(place_.path(), {"run", "walk.yaml", "--json", "--out", "run"});
  EXPECT_EQ(outcome.status, kFailed);
  EXPECT_THAT(outcome.err, StartsWith("halfstep: the plan is not feasible; worst first:\n  start: "
                                      "the left foot is 0.17 m to the right of the right foot; "
                                      "left and right look exchanged in `start`\n"));
  const auto json = nlohmann::json::parse(outcome.out);
  const auto& raw = json["infeasible"]["raw"];
  EXPECT_THAT(raw["inputs"][0].get<std::string>(), HasSubstr("look exchanged in `start`"));
  EXPECT_GE(raw["missed"].size(), 1u);
  EXPECT_EQ(nlohmann::json::parse(ReadText(place_ / "run/infeasible.json"))["raw"], raw);
}

// One blame: the footstep that put the foot there is named, first of all, and remedies are tried
// there, in text and JSON; the list holds whatever the table calls the worst.
TEST_F(PlanInputsTest, AFootInAPlankIsBlamedOnItsFootstep) {
  Write(start_, good_ + "  - {foot: right, x_m: 0.4, y_m: -0.085}\n", Plank());
  const Outcome outcome = Halfstep(place_.path(), {"run", "walk.yaml", "--json", "--out", "run"});
  EXPECT_EQ(outcome.status, kFailed);
  EXPECT_THAT(outcome.err, StartsWith("halfstep: the plan is not feasible; worst first:\n"
                                      "  footstep 2 (right) stands 1.0 mm inside plank\n"
                                      "  footstep 4 (right) stands 1.0 mm inside plank\n"
                                      "  footstep 2 (right), "));
  const auto raw = nlohmann::json::parse(outcome.out)["infeasible"]["raw"];
  const auto& worst = raw["missed"][0];
  EXPECT_EQ(worst["footstep"], 2);
  EXPECT_EQ(worst["family"], "clearance");
  EXPECT_LT(worst["t_s"].get<double>(), 8.0);
  bool tried = false;
  for (const auto& line : raw["help"]) {
    tried = tried || line.get<std::string>().find("footstep 2: ") != std::string::npos;
  }
  EXPECT_TRUE(tried) << raw["help"];
}

class GoalInputsTest : public PlanInputsTest {
 protected:
  Outcome Plan(const std::string& scene, const std::string& goal,
               const std::vector<std::string>& more = {}) const {
    WriteText(place_ / "scene.yaml", scene);
    WriteText(place_ / "goal.yaml",
              "robot: hrp2\nscene: scene.yaml\ngoal: " + goal +
                  "\nstep_set: {x_min_m: 0, x_max_m: 0.2, y_min_m: -0.21, y_max_m: -0.21,\n"
                  "           spacing_m: 0.2, yaws_rad: [0]}\n"
                  "swept_volumes: {cell_m: 0.05, displacement_m: 0.05, cache: cache}\n"
                  "planner: {unimproved_nodes: 0, max_nodes: 200}\nsmoothing: {methods: []}\n");
    std::vector<std::string> arguments = {"plan", "goal.yaml"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Halfstep(place_.path(), arguments);
  }
};

TEST_F(GoalInputsTest, AGoalInAnObstacleIsToldFirst) {
  const std::string table =
      "obstacles: [{name: table, box: {size_m: [0.6, 0.6, 0.4]},\n"
      "             pose: {xyz: [1, 0, 0.2]}}]\n";
  const Outcome outcome = Plan(table, "{x_m: 1, y_m: 0}");
  EXPECT_EQ(outcome.status, kFailed);
  EXPECT_THAT(outcome.err, StartsWith("halfstep: no plan: goal: of 637 places of a sole in it that "
                                      "were tried none is free: table is in the way; "));
  const Outcome json = Plan(table, "{x_m: 1, y_m: 0}", {"--json"});
  EXPECT_THAT(nlohmann::json::parse(json.out)["inputs"][0].get<std::string>(),
              HasSubstr("table is in the way"));
}

TEST_F(GoalInputsTest, AGoalOnANoStepAreaIsToldFirst) {
  const Outcome outcome = Plan(
      "no_step: [{name: hole, polygon_m: [[0.5, -0.5], [1.5, -0.5], [1.5, 0.5], [0.5, 0.5]]}]\n",
      "{x_m: 1, y_m: 0}");
  EXPECT_EQ(outcome.status, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("goal: of 637 places of a sole in it that were tried none is "
                                     "free: no-step areas are in the way; "));
}

TEST_F(GoalInputsTest, AFootThatStartsInAnObstacleIsToldFirst) {
  const Outcome outcome = Plan(
      "obstacles: [{name: box, box: {size_m: [0.05, 0.1, 0.02]},\n"
      "             pose: {xyz: [0, -0.22, 0.01]}}]\n",
      "{x_m: 0.6, y_m: 0}");
  EXPECT_EQ(outcome.status, kFailed);
  EXPECT_THAT(outcome.err, StartsWith("halfstep: no plan: start: the right foot stands "));
  EXPECT_THAT(outcome.err, HasSubstr(" mm inside box; neither foot can leave the floor"));
}

TEST_F(GoalInputsTest, AStartInTheGoalNeedsNoPlan) {
  const Outcome outcome = Plan("obstacles: []\n", "{x_m: 0, y_m: 0.1}");
  EXPECT_EQ(outcome.status, kSuccess);
  EXPECT_EQ(outcome.out, "") << "no config that `run` would refuse";
  EXPECT_THAT(outcome.err, HasSubstr("the start is in the goal: nothing to plan\n"));
  EXPECT_THAT(outcome.err, Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace halfstep
