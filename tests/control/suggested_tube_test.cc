#include "experiments/replay/suggested_tube.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/commands/commands.h"
#include "experiments/config/data_folder.h"
#include "experiments/config/experiment.h"
#include "experiments/replay/mujoco_model.h"
#include "experiments/replay/planned_row.h"
#include "smoothing/walk/superposed_walk.h"
#include "tests/experiments/child_process.h"
#include "tests/refusal_of.h"
#include "tests/temporary_folder.h"
#include "wpg/geometry/rotation.h"

namespace halfstep::replay {
namespace {

using testing::HasSubstr;

/// HRP-2 and two half-steps, every 5 ms.
class SuggestedTubeTest : public testing::Test {
 protected:
  std::vector<TrajectoryRow> Walk() const {
    const Experiment experiment = Prepare(LoadConfig(ShippedConfig("fig3_two_half_steps"), {}));
    const SuperposedWalk walk(experiment.sequence, PlannedMotion(experiment.sequence));
    std::vector<TrajectoryRow> rows;
    for (int i = 0; i <= 800; ++i) rows.push_back(PlannedRow(whole_.model, walk, 0.005 * i));
    return rows;
  }
  MeasuredTube Sized(double size) const {
    MeasuredTube tube;
    for (double Tube::*const part : kTubeParts) tube.largest.*part = size;
    return tube;
  }

  const WholeRobot whole_ = LoadWholeRobot((RobotsFolder() / "hrp2.yaml").string());
  const ReferenceMotion motion_{Walk()};
};

// Where it is shifted and turned by known amounts, just these are measured, in W.
TEST_F(SuggestedTubeTest, TheGaugeMeasuresWhatARobotWasMovedBy) {
  if (!WhyNoSimulation().empty()) GTEST_SKIP() << WhyNoSimulation();
  Simulation robot{MujocoModel(whole_.model, whole_.tree, {}), whole_.model, "WAIST"};
  const TubeGauge gauge(whole_.model, motion_);
  const PlannedStates planned(whole_.model, motion_);
  constexpr double kAt = 1.0, kPeriod = 0.005;
  const control::PlannedState middle = planned.At(kAt - kPeriod / 2);
  ReplayRow row;
  row.t = kAt;
  row.zmp_measured = middle.zmp + Eigen::Vector2d(0.0, 0.01);
  for (size_t s = 0; s < 2; ++s) row.vertical[s] = middle.stands[s] ? 1.0 : 0.0;
  const TrajectoryRow plan = motion_.RowAt(kAt);
  Eigen::Isometry3d X_WB = plan.X_WB();
  robot.Place(X_WB, plan.q);
  Tube tube = gauge.Of(robot, row, kPeriod).tube;
  const double speed = tube.joint_speed;  // it rests
  EXPECT_GT(speed, 0.01);
  EXPECT_LT(tube.foot + tube.foot_turn + tube.waist + tube.waist_turn + tube.joint, 1e-6);
  EXPECT_NEAR(tube.zmp, 0.01, 1e-12);

  constexpr double kTurn = 0.002;
  X_WB.translation() += Eigen::Vector3d(0.003, 0.0, 0.004);
  X_WB.linear() = (RollPitchYaw(kTurn, 0.0, 0.0) * X_WB.linear()).eval();
  std::array<Vector6d, 2> q = plan.q;
  q[1][3] += 0.001;
  robot.Place(X_WB, q);
  tube = gauge.Of(robot, row, kPeriod).tube;
  EXPECT_NEAR(tube.waist, 0.005, 1e-9);
  EXPECT_NEAR(tube.waist_turn, kTurn, 1e-9);
  EXPECT_NEAR(tube.joint, 0.001, 1e-9);
  EXPECT_GE(tube.foot_turn, kTurn);
  EXPECT_NEAR(tube.foot, 0.005, 0.003);  // the waist's turn moves soles

  row.vertical = {1.0, 1.0};
  row.vertical[middle.stands[0] ? 0 : 1] = 0.0;
  const TubeSample beside = gauge.Of(robot, row, kPeriod);
  EXPECT_EQ(beside.tube.zmp, 0.0);
  EXPECT_NEAR(beside.zmp_beside.value(), 0.01, 1e-12);
}

// What it has drifted and turned before the walk begins does not count, what it does then, does.
TEST_F(SuggestedTubeTest, ThePlanBeginsWhereTheRobotStands) {
  if (!WhyNoSimulation().empty()) GTEST_SKIP() << WhyNoSimulation();
  Simulation robot{MujocoModel(whole_.model, whole_.tree, {}), whole_.model, "WAIST"};
  TubeGauge gauge(whole_.model, motion_);
  const Pose2 drift{0.02, -0.03, 0.1};
  const auto place = [&](const Pose2& more, double t) {
    const TrajectoryRow plan = motion_.RowAt(t);
    robot.Place(ToIsometry(drift * more, 0.0) * plan.X_WB(), plan.q);
  };
  place({}, 0.0);
  gauge.BeginAt(robot);
  place({}, 3.0);
  ReplayRow row;
  row.t = 3.0;
  const Tube tube = gauge.Of(robot, row, 0.005).tube;
  EXPECT_LT(tube.foot + tube.foot_turn + tube.waist + tube.waist_turn, 1e-6);
  place({0.004, 0.003, 0.0}, 3.0);
  EXPECT_NEAR(gauge.Of(robot, row, 0.005).tube.foot, 0.005, 1e-6);
}

TEST_F(SuggestedTubeTest, OfInstantsIsTheLargestAndWhat95PercentKeep) {
  std::vector<TubeSample> samples(100);
  for (size_t i = 0; i < samples.size(); ++i) {
    samples[i].tube.foot = static_cast<double>(i + 1);
    samples[i].tube.zmp = 1.0;
  }
  samples[7].tube.zmp = 0.0;
  samples[7].zmp_beside = 5.0;
  const MeasuredTube tube(samples);
  EXPECT_EQ(tube.most.foot, 95.0);
  EXPECT_EQ(tube.largest.foot, 100.0);
  EXPECT_EQ(tube.largest.zmp, 1.0);
  EXPECT_EQ(tube.beside, 0.01);
  EXPECT_EQ(tube.zmp_beside, 5.0);
  EXPECT_EQ(MeasuredTube(std::vector<TubeSample>{}).largest, Tube{});
}

// What is printed is what a config takes, and no less than what was measured.
TEST_F(SuggestedTubeTest, CanBePastedIntoAConfig) {
  const SuggestedTube tube = SuggestTube({Sized(0.0123), Sized(0.0101)}, 3, whole_.model);
  const std::string text = SuggestedTubeText("dichotomy", tube);
  EXPECT_THAT(text, HasSubstr("in 2 of 3 simulations (it falls in the others)"));
  const ExperimentConfig config = ParseConfig(ShippedConfig("fig3_two_half_steps"),
                                              "name: pasted\nrobot: hrp2\nscene: none\nfootsteps: "
                                              "[{foot: right, x_m: 0.2, y_m: -0.105}]\n" +
                                                  text,
                                              {});
  const Tube& pasted = config.smoothing.limits.tube;
  for (double Tube::*const part : kTubeParts) {
    EXPECT_GE(pasted.*part, 0.0123);
    EXPECT_LE(pasted.*part, 0.0132);
  }
}

TEST_F(SuggestedTubeTest, LeavesOutWhatNoSoleHolds) {
  MeasuredTube wide = Sized(0.01);
  wide.largest.zmp = 0.5 * whole_.model.sole_size.minCoeff();
  const SuggestedTube tube = SuggestTube({wide}, 1, whole_.model);
  EXPECT_FALSE(SuggestedTubeJson(tube)["tube"].contains("zmp_m"));
  EXPECT_THAT(SuggestedTubeText("raw", tube), HasSubstr("    # zmp_m: 0.069  # 0: more than"));
}

TEST_F(SuggestedTubeTest, IsNoneWhereNothingStandsOrKeysDoNotTakeIt) {
  EXPECT_THAT(SuggestedTubeText("raw", SuggestTube({}, 8, whole_.model)),
              HasSubstr("raw: no tube is suggested: the robot falls in every simulation"));
  const SuggestedTube wide = SuggestTube({Sized(0.6)}, 1, whole_.model);
  EXPECT_THAT(SuggestedTubeText("raw", wide), HasSubstr("foot_m would be 0.6 (valid: 0 … 0.5)"));
  EXPECT_TRUE(SuggestedTubeJson(wide)["tube"].is_null());
}

// Softer servos are farther off; what makes no sense is refused.
TEST_F(SuggestedTubeTest, TheCommandSuggestsWiderTubesForSofterServos) {
  const TemporaryFolder place;
  const std::string run = (place / "run").string();
  const auto run_command = [&place](const std::vector<std::string>& words) {
    return Halfstep(place.path(), words);
  };
  const Outcome made = run_command({"run", ShippedConfig("fig3_two_half_steps"), "--set",
                                    "smoothing.methods=[dichotomy]", "--out", run, "--quiet"});
  ASSERT_EQ(made.status, kSuccess) << made.err;
  const std::vector<std::string> suggest = {"replay",    run,      "--method",
                                            "dichotomy", "--json", "--suggest-tube"};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = suggest;
    all.insert(all.end(), more.begin(), more.end());
    return run_command(all);
  };
  EXPECT_THAT(with({"--push"}).err, HasSubstr("--suggest-tube: a walk that --push makes fall"));
  EXPECT_THAT(with({"--floor", "slope=1"}).err, HasSubstr("about the floor that is planned"));
  if (!WhyNoSimulation().empty()) GTEST_SKIP() << WhyNoSimulation();
  const auto tube = [](const Outcome& outcome) {
    return nlohmann::json::parse(outcome.out)["methods"][0]["suggested_tube"];
  };
  const auto stiff = tube(with({})), soft = tube(with({"--servos", "10000,300", "--seeds", "1"}));
  EXPECT_GT(soft["largest"]["joint_rad"], 2 * stiff["largest"]["joint_rad"].get<double>());
  for (const auto& [key, value] : stiff["tube"].items()) {
    EXPECT_GE(value, stiff["largest"][key]);
    EXPECT_GE(stiff["largest"][key], stiff["most"][key]);
  }
  EXPECT_EQ(soft["of"], 1);
}

}  // namespace
}  // namespace halfstep::replay
