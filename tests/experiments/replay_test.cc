#include "experiments/replay/replay.h"
#include "experiments/config/data_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/commands/commands.h"
#include "experiments/config/experiment.h"
#include "experiments/replay/mass_model_zmp.h"
#include "experiments/replay/mujoco_model.h"
#include "experiments/replay/planned_row.h"
#include "smoothing/walk/superposed_walk.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/parsed_csv.h"
#include "tests/experiments/robot_motion_at.h"
#include "tests/temporary_folder.h"
#include "wpg/robot/leg_ik.h"

namespace halfstep::replay {
namespace {

using testing::HasSubstr;

constexpr double kDegree = M_PI / 180;

/// HRP-2 and two half-steps one after the other, every 5 ms.
class ReplayTest : public testing::Test {
 protected:
  /// The waist shifted sideways, the feet where they are.
  std::vector<TrajectoryRow> Walk(double shift) const {
    const Experiment experiment = Prepare(LoadConfig(ShippedConfig("fig3_two_half_steps"), {}));
    const SuperposedWalk walk(experiment.sequence, PlannedMotion(experiment.sequence));
    std::vector<TrajectoryRow> rows;
    for (int i = 0; i <= 800; ++i) {
      TrajectoryRow& row = rows.emplace_back(PlannedRow(robot_, walk, 0.005 * i));
      row.waist.y() += shift;
      for (const Side side : {Side::kLeft, Side::kRight}) {
        const auto s = static_cast<size_t>(Index(side));
        const LegIkSolution leg =
            SolveLegIk(robot_.legs[s], row.X_WB().inverse() * TrajectoryRow::Upright(row.soles[s]));
        EXPECT_EQ(leg.status, LegIkStatus::kSolved);
        row.q[s] = leg.q;
      }
    }
    return rows;
  }
  Simulation Robot() const {
    return {MujocoModel(robot_, tree_, {}), robot_,
            tree_.urdf.links[static_cast<size_t>(tree_.waist)].name};
  }

  const std::string file_ = (RobotsFolder() / "hrp2.yaml").string();
  const WholeRobot whole_ = LoadWholeRobot(file_);
  const RobotModel& robot_ = whole_.model;
  const RobotTree& tree_ = whole_.tree;
};

#define SKIP_WITHOUT_SIMULATION() \
  if (!WhyNoSimulation().empty()) GTEST_SKIP() << WhyNoSimulation()

// Joint torques, and force and moment on the robot, as the engine's inverse dynamics has them.
TEST_F(ReplayTest, TheDynamicsAreThoseOfTheEngine) {
  SKIP_WITHOUT_SIMULATION();
  Simulation engine(MujocoModel(robot_, tree_, {.armature = 0.0, .principal_axes = true}), robot_,
                    tree_.urdf.links[static_cast<size_t>(tree_.waist)].name);
  const Experiment experiment = Prepare(LoadConfig(ShippedConfig("fig3_two_half_steps"), {}));
  const SuperposedWalk walk(experiment.sequence, PlannedMotion(experiment.sequence));
  for (double t = 0.1; t < walk.duration(); t += 0.1) {
    const WalkJet jet = walk.At(t);
    Posture posture = SolvePosture(robot_, jet.value);
    ASSERT_TRUE(posture.reachable && SolveJointSpeeds(robot_, jet, &posture));
    const RobotDynamics dynamics(robot_, jet, posture, 9.81);
    RobotMotion motion = RobotMotionAt(robot_, jet, posture, dynamics);
    EXPECT_LT(OffFromEngine(engine.Needed(motion), posture, dynamics), 1e-9) << t;
    motion.accelerations[0][2] += 0.01;
    EXPECT_GT(OffFromEngine(engine.Needed(motion), posture, dynamics), 1e-6) << t;
  }
}

TEST_F(ReplayTest, ModelWeighsWhatTheRobotDoes) {
  SKIP_WITHOUT_SIMULATION();
  EXPECT_NEAR(Robot().weight(), 9.81 * robot_.mass, 1e-2);
}

// MuJoCo's root body is called "world", its floor "floor", and it reads XML.
TEST_F(ReplayTest, LinksAndJointsMayHaveAnyName) {
  SKIP_WITHOUT_SIMULATION();
  const double weight = Robot().weight();
  for (const std::vector<std::string>& names :
       {std::vector<std::string>{"world", "world_", "floor"},
        {"world_", "world", "world__"},
        {"a<b&\"c\"", "body_0", "obstacle_0"},
        {"left_sole", "null", "</body>"}}) {
    RobotModel robot = robot_;
    RobotTree tree = tree_;
    for (size_t i = 0; i < names.size(); ++i) {
      tree.urdf.links[i].name = names[i];
      LegJoint& joint = robot.legs[0].joints[i];
      for (UrdfJoint& one : tree.urdf.joints) {
        if (one.name == joint.name) one.name = names[i];
      }
      joint.name = names[i];
    }
    const SimulatedObstacle box{
        .name = "world", .body = MakeBox({0.1, 0.1, 0.1}), .pose = [](double) {
          return Eigen::Isometry3d(Eigen::Translation3d(3.0, 0.0, 0.0));
        }};
    const Simulation engine(MujocoModel(robot, tree, {}, {box}), robot,
                            tree.urdf.links[static_cast<size_t>(tree.waist)].name, {box});
    EXPECT_NEAR(engine.weight(), weight, 1e-9) << names[0];
  }
}

TEST_F(ReplayTest, RefusesAModelThatIsNone) {
  SKIP_WITHOUT_SIMULATION();
  EXPECT_THROW(Simulation("<mujoco><worldbody><body/>", robot_, "WAIST"), std::runtime_error);
}

TEST_F(ReplayTest, StandsStillAndCarriesItsWeight) {
  SKIP_WITHOUT_SIMULATION();
  std::vector<TrajectoryRow> rows(2, Walk(0.0).front());
  rows[1].t = 0.5;
  const ReplayResult result = Play(Robot(), ReferenceMotion(rows), {});
  EXPECT_TRUE(result.stayed_up);
  EXPECT_NEAR(result.weight_share, 1.0, 0.01);
  EXPECT_LT(result.largest_tilt, 0.2 * kDegree);
  EXPECT_LT(result.zmp_largest, 0.005);
  EXPECT_LT(result.slip, 1e-4);
}

TEST_F(ReplayTest, AWalkStaysUp) {
  SKIP_WITHOUT_SIMULATION();
  const ReferenceMotion motion(Walk(0.0));
  const ReplayResult result = Play(Robot(), motion, {});
  EXPECT_TRUE(result.stayed_up);
  EXPECT_NEAR(result.ended, motion.end() + PlayOptions().hold, 0.01);
  EXPECT_NEAR(result.weight_share, 1.0, 0.01);
  EXPECT_LT(result.largest_tilt, 1.0 * kDegree);
  EXPECT_LT(result.zmp_rms, 0.05);
  EXPECT_LT(result.slip, 0.005);
  EXPECT_LT(result.drift, 0.01);
}

TEST_F(ReplayTest, AWalkWithItsMassBesideTheFeetFalls) {
  SKIP_WITHOUT_SIMULATION();
  const ReferenceMotion motion(Walk(-0.15));
  const ReplayResult result = Play(Robot(), motion, {});
  EXPECT_FALSE(result.stayed_up);
  EXPECT_LT(result.ended, motion.end());
}

TEST_F(ReplayTest, SurvivesAPushBelowTheLimitAndNotAboveIt) {
  SKIP_WITHOUT_SIMULATION();
  std::vector<TrajectoryRow> rows(2, Walk(0.0).front());
  rows[1].t = 0.5;
  const ReferenceMotion motion(rows);
  PushOptions pushes;
  pushes.directions = 1;
  pushes.tolerance = 10.0;
  const std::vector<PushLimit> limits =
      FindPushLimits(Robot(), motion, {}, pushes, {0.1}, [](double) {}, {});
  ASSERT_EQ(limits.size(), 1u);
  EXPECT_GT(limits[0].survived, 10.0);
  EXPECT_LE(limits[0].fell - limits[0].survived, pushes.tolerance);
}

std::string ReplacedIn(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

// HRP-2 with its soles as links of their own, as URDFs of other robots have them: fixed to the
// ankles, of a little mass and without inertia.
WholeRobot RobotWithSoleLinks(const TemporaryFolder& place) {
  const std::string folder = RobotsFolder().string();
  std::string urdf = ReadText(folder + "/hrp2.urdf"), yaml = ReadText(folder + "/hrp2.yaml");
  yaml = ReplacedIn(yaml, "./hrp2}", folder + "/hrp2}");
  for (const auto& [side, y] : {std::pair{'L', "0.010"}, std::pair{'R', "-0.010"}}) {
    const std::string ankle = std::string(1, side) + "LEG_LINK5";
    const std::string sole = std::string(1, side) + "SOLE", offset = std::string("0.015") + " " + y;
    urdf = ReplacedIn(urdf, "</robot>",
                      "<link name='" + sole +
                          "'><inertial><mass value='0.001'/><inertia ixx='0' ixy='0' ixz='0' "
                          "iyy='0' iyz='0' izz='0'/></inertial></link><joint name='" +
                          sole + "_FIX' type='fixed'><parent link='" + ankle + "'/><child link='" +
                          sole + "'/><origin xyz='" + offset + " -0.105'/></joint></robot>");
    yaml = ReplacedIn(yaml, ankle + ", sole_xyz: [0.015, " + y + ", -0.105]",
                      sole + ", sole_xyz: [0, 0, 0]");
  }
  WriteText(place / "hrp2.urdf", urdf);
  return LoadWholeRobot(WriteText(place / "hrp2.yaml", yaml));
}

TEST_F(ReplayTest, SolesThatAreLinksOfTheirOwnStandWhereTheyAre) {
  SKIP_WITHOUT_SIMULATION();
  const TemporaryFolder place;
  const auto [robot, tree] = RobotWithSoleLinks(place);
  Simulation simulation(MujocoModel(robot, tree, {}), robot, "WAIST");
  const TrajectoryRow row = Walk(0.0).front();
  simulation.Place(row.X_WB(), row.q);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Eigen::Isometry3d planned =
        TrajectoryRow::Upright(row.soles[static_cast<size_t>(Index(side))]);
    EXPECT_TRUE(simulation.X_WSole(side).isApprox(planned, 1e-9)) << Name(side);
  }
}

// At rest the ZMP is below the CoM.
TEST_F(ReplayTest, MassModelStandsOverItsCom) {
  std::vector<TrajectoryRow> rows(2, Walk(0.0).front());
  rows[1].t = 0.5;
  for (size_t side = 0; side < 2; ++side) {
    rows[0].q[side] = rows[1].q[side] = robot_.legs[side].standing_q;
  }
  const Eigen::Vector2d zmp = MassModelZmp(robot_, tree_, rows)[0];
  EXPECT_NEAR(zmp.x(), rows[0].waist.x() + robot_.com_x_B, 1e-9);
  EXPECT_NEAR(zmp.y(), rows[0].waist.y(), 0.002);
}

TEST_F(ReplayTest, ReferenceMeetsTheRowsAndRestsAtItsEnds) {
  const std::vector<TrajectoryRow> rows = Walk(0.0);
  const ReferenceMotion motion(rows);
  for (size_t i = 0; i < rows.size(); i += 50) {
    EXPECT_NEAR((motion.TargetsAt(rows[i].t).q[1] - rows[i].q[1]).norm(), 0.0, 1e-12);
  }
  const JointTargets after = motion.TargetsAt(motion.end() + 1.0);
  EXPECT_NEAR((after.q[0] - rows.back().q[0]).norm(), 0.0, 1e-12);
  EXPECT_NEAR(after.speed[0].norm(), 0.0, 1e-12);
  const double t = 0.7 * motion.end(), h = 1e-5;
  const Vector6d slope = (motion.TargetsAt(t + h).q[1] - motion.TargetsAt(t - h).q[1]) / (2 * h);
  EXPECT_NEAR((motion.TargetsAt(t).speed[1] - slope).norm(), 0.0, 1e-5);
}

TEST(ReplayCommand, WritesItsCsvOrSaysWhyNot) {
  const TemporaryFolder place;
  ASSERT_EQ(Halfstep(place.path(), {"run", ShippedConfig("fig3_two_half_steps"), "--out", "run",
                                    "--quiet", "--set", "smoothing.methods=[dichotomy]"})
                .status,
            kSuccess);
  const Outcome outside =
      Halfstep(place.path(), {"replay", "run", "--push", "--push-at", "1", "99"});
  EXPECT_EQ(outside.status, kBadInput);
  EXPECT_THAT(outside.err, HasSubstr("--push-at 99: is not within the walk (valid: 0 … 4)"));
  const Outcome outcome =
      Halfstep(place.path(), {"replay", "run", "--method", "dichotomy", "--out", "--json"});
  if (!WhyNoSimulation().empty()) {
    EXPECT_EQ(outcome.status, kFailed);
    EXPECT_THAT(outcome.err, HasSubstr(WhyNoSimulation()));
    return;
  }
  ASSERT_EQ(outcome.status, kSuccess) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_TRUE(json["methods"][0]["stayed_up"]);
  EXPECT_THAT(json["statement"].get<std::string>(), HasSubstr("guarantees nothing"));
  const ParsedCsv table(ReadText(place / "run/dichotomy/replay.csv"));
  EXPECT_NEAR(table.Number(table.size() - 1, "t_s"), json["methods"][0]["ended_s"], 1e-9);
  const auto schema = nlohmann::json::parse(ReadText(place / "run/dichotomy/replay.schema.json"));
  EXPECT_EQ(schema["fields"].size(), table.header().size());
  EXPECT_EQ(Halfstep(place.path(), {"verify", "run", "--quiet"}).status, kSuccess);
}

}  // namespace
}  // namespace halfstep::replay
