#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/config/data_folder.h"
#include "experiments/config/experiment.h"
#include "experiments/replay/planned_row.h"
#include "experiments/replay/robot_physics.h"
#include "experiments/replay/run_replay.h"
#include "experiments/replay/seeds_screen.h"
#include "experiments/run/exit_status.h"
#include "smoothing/walk/superposed_walk.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/parsed_csv.h"
#include "tests/refusal_of.h"
#include "tests/temporary_folder.h"
#include "wpg/robot/robot_measures.h"

namespace halfstep::replay {
namespace {

using testing::HasSubstr;

constexpr double kOneDegree = M_PI / 180;

#define SKIP_WITHOUT_SIMULATION() \
  if (!WhyNoSimulation().empty()) GTEST_SKIP() << WhyNoSimulation()

WholeRobot Shipped(const std::string& robot) {
  return LoadWholeRobot((RobotsFolder() / (robot + ".yaml")).string());
}

// HRP-2 and two half-steps one after the other, every 5 ms.
std::vector<TrajectoryRow> Walk(const std::string& config = "fig3_two_half_steps") {
  const Experiment experiment = Prepare(LoadConfig(ShippedConfig(config), {}));
  const SuperposedWalk walk(experiment.sequence, PlannedMotion(experiment.sequence));
  std::vector<TrajectoryRow> rows;
  for (int i = 0; i <= 800; ++i) rows.push_back(PlannedRow(experiment.robot, walk, 0.005 * i));
  return rows;
}

std::vector<TrajectoryRow> Standing() {
  std::vector<TrajectoryRow> rows(2, Walk().front());
  rows[1].t = 0.5;
  return rows;
}

ReplaySetup Hrp2(const std::vector<double>& ankle = {}) {
  ReplayConfig options;
  options.ankle = ankle;
  return SetupOf(Shipped("hrp2"), {}, options);
}

// Played without a disturbance; of the floor that seed 1 draws.
ReplayResult Played(const ReplaySetup& setup, const std::vector<TrajectoryRow>& rows) {
  const ReferenceMotion motion(rows);
  return Play(setup.Robot(DrawWorld(1, setup, motion).floor), motion, setup.play);
}

// x → λ x, m → λ³ m, t → √λ t: under the same g such robots move alike.
Eigen::Isometry3d Scaled(Eigen::Isometry3d X, double scale) {
  X.translation() *= scale;
  return X;
}
WholeRobot Scaled(WholeRobot whole, double scale) {
  RobotModel& robot = whole.model;
  robot.mass *= std::pow(scale, 3);
  robot.sole_size *= scale;
  for (Leg& leg : robot.legs) {
    leg.hip_B *= scale;
    leg.ankle_B *= scale;
    leg.X_BSole = Scaled(leg.X_BSole, scale);
    for (LegJoint& joint : leg.joints) {
      joint.X_BLink = Scaled(joint.X_BLink, scale);
      joint.point_B *= scale;
    }
  }
  for (UrdfLink& link : whole.tree.urdf.links) {
    link.mass *= std::pow(scale, 3);
    link.com *= scale;
    link.inertia *= std::pow(scale, 5);
  }
  for (UrdfJoint& joint : whole.tree.urdf.joints) {
    joint.X_ParentChild = Scaled(joint.X_ParentChild, scale);
  }
  return whole;
}
std::vector<TrajectoryRow> Scaled(std::vector<TrajectoryRow> rows, double scale) {
  for (TrajectoryRow& row : rows) {
    row.t *= std::sqrt(scale);
    row.zmp *= scale;
    row.waist.head<3>() *= scale;
    for (Eigen::Vector4d& sole : row.soles) sole.head<3>() *= scale;
  }
  return rows;
}

TEST(RobotPhysics, Hrp2HasItsNumbersExactly) {
  const ModelOptions physics = PhysicsOf(Shipped("hrp2").model), published;
  EXPECT_EQ(physics.timestep, published.timestep);
  EXPECT_EQ(physics.friction, published.friction);
  EXPECT_EQ(physics.stiffness, published.stiffness);
  EXPECT_EQ(physics.damping, published.damping);
  EXPECT_EQ(physics.armature, published.armature);
  EXPECT_EQ(physics.contact_time, published.contact_time);
  EXPECT_EQ(PlayOptionsOf(Shipped("hrp2").model).edge, PlayOptions().edge);
}

TEST(RobotPhysics, OtherRobotsFollowTheLaw) {
  const RobotModel hrp2 = Shipped("hrp2").model;
  const ModelOptions from = PhysicsOf(hrp2);
  for (const char* name : {"wren", "bison"}) {
    const RobotModel robot = Shipped(name).model;
    const ModelOptions to = PhysicsOf(robot);
    const double mass = robot.mass / hrp2.mass, length = LegLengthOf(robot) / LegLengthOf(hrp2);
    const auto is = [&](double value, double hrp2s, double scale) {
      EXPECT_NEAR(value / (hrp2s * scale), 1.0, 0.01) << name;
    };
    is(to.stiffness, from.stiffness, mass * length);
    is(to.armature, from.armature, mass * length * length);
    is(to.damping / std::sqrt(to.stiffness * to.armature),
       from.damping / std::sqrt(from.stiffness * from.armature), 1.0);
    is(to.contact_time, from.contact_time, std::sqrt(length));
    EXPECT_GE(to.contact_time, 2 * to.timestep) << name;
    const double periods = PlayOptions().row_period / to.timestep;
    EXPECT_NEAR(periods, std::round(periods), 1e-9) << name;
  }
  EXPECT_LT(PhysicsOf(Shipped("wren").model).armature, 0.002);
}

TEST(RobotPhysics, ASimilarRobotDoesTheSame) {
  SKIP_WITHOUT_SIMULATION();
  constexpr double kScale = 0.25;
  ReplaySetup large = Hrp2(), small = SetupOf(Scaled(Shipped("hrp2"), kScale), {}, {});
  for (ReplaySetup* setup : {&large, &small}) {  // soft, so that there is something to compare
    setup->model.stiffness *= 0.1;
    setup->model.damping *= 0.15;
  }
  for (double PlayOptions::*duration :
       {&PlayOptions::settle, &PlayOptions::hold, &PlayOptions::row_period}) {
    small.play.*duration *= std::sqrt(kScale);
  }
  const ReplayResult expected = Played(large, Walk());
  const ReplayResult result = Played(small, Scaled(Walk(), kScale));
  EXPECT_GT(expected.largest_tilt, 0.5 * kOneDegree);
  EXPECT_NEAR(result.largest_tilt / expected.largest_tilt, 1.0, 0.02);
  EXPECT_NEAR(result.zmp_rms / expected.zmp_rms, kScale, 0.02 * kScale);
  EXPECT_NEAR(result.peak / expected.peak, 1.0, 0.02);
  small.model = large.model;  // HRP-2's servos and rotors are other ones to this robot
  EXPECT_GT(
      std::abs(Played(small, Scaled(Walk(), kScale)).largest_tilt / expected.largest_tilt - 1),
      0.1);
}

TEST(Seeds, DrawTheSameEachTimeAndForEveryNumber) {
  SKIP_WITHOUT_SIMULATION();
  ReplaySetup setup = Hrp2();
  setup.relief = ParseRelief("", "plates=0.004,slope=0.5");
  const ReferenceMotion motion(Standing());
  const auto played = [&](int seeds) {
    return SeedsCsv(PlaySeeds(setup, motion, seeds, [](double) {}, {})).text;
  };
  const std::string three = played(3);
  EXPECT_EQ(played(3), three);
  EXPECT_TRUE(three.starts_with(played(2)));
  const ParsedCsv table(three);
  for (const char* drawn : {"friction", "contact_s", "stiffness_share", "com_x_m", "com_y_m",
                            "push_s", "push_yaw_rad", "largest_tilt_rad"}) {
    EXPECT_NE(table.Number(0, drawn), table.Number(1, drawn)) << drawn;
  }
  EXPECT_NEAR(table.Number(0, "push_n_s"), 2.0, 1e-9);
}

TEST(Seeds, AreWithinTheirRanges) {
  const RobotModel wren = Shipped("wren").model;
  const RobotScale scale = ScaleOf(wren);
  const double contact = PhysicsOf(wren).contact_time;
  for (int seed = 1; seed <= 200; ++seed) {
    SeedDraws draws(seed);
    const Disturbance drawn = DrawDisturbance(wren, 3.0, &draws);
    EXPECT_TRUE(drawn.friction >= 0.5 && drawn.friction <= 0.8);
    EXPECT_TRUE(drawn.contact_time >= contact && drawn.contact_time <= 2 * contact);
    EXPECT_LE(std::abs(drawn.stiffness_share - 1.0), 0.1);
    EXPECT_LE(drawn.com_shift.cwiseAbs().maxCoeff(), 0.01 * scale.length);
    EXPECT_TRUE(drawn.push.at >= 0.0 && drawn.push.at <= 3.0);
    EXPECT_NEAR(drawn.push.impulse_W.norm(), 2.0 * scale.mass * std::sqrt(scale.length), 1e-12);
  }
}

TEST(ReplayWorlds, TheCentreOfMassShiftsThePressurePoint) {
  SKIP_WITHOUT_SIMULATION();
  ReplaySetup setup = Hrp2();
  const double level = Played(setup, Standing()).rows.back().zmp_measured.y();
  setup.model.com_shift = {0.0, 0.01};
  const double shifted = Played(setup, Standing()).rows.back().zmp_measured.y();
  EXPECT_GT(shifted - level, 0.004);  // not all of the mass is above the legs
  EXPECT_LT(shifted - level, 0.012);
}

TEST(ReplayWorlds, AStandingRobotIsNotAtTheEdgeAndDoesNotFly) {
  SKIP_WITHOUT_SIMULATION();
  const ReplayResult result = Played(Hrp2(), Standing());
  EXPECT_EQ(result.edge_share, 0.0);
  EXPECT_EQ(result.flight, 0.0);
  EXPECT_NEAR(result.peak, 1.0, 0.05);
  EXPECT_LT(result.turn, 1e-3);
  EXPECT_GT(result.rows.back().edge, 0.05);
}

// It leans until it rests on its toes.
TEST(ReplayWorlds, ALeaningRobotIsAtTheEdge) {
  SKIP_WITHOUT_SIMULATION();
  std::vector<TrajectoryRow> rows = Standing();
  for (TrajectoryRow& row : rows) {
    for (Vector6d& q : row.q) q[4] += 0.12;  // ankle pitch
  }
  const ReplayResult result = Played(Hrp2(), rows);
  EXPECT_GT(result.edge_share, 0.3);
}

TEST(ReplayWorlds, WithoutTorqueItFalls) {
  SKIP_WITHOUT_SIMULATION();
  ReplaySetup setup = Hrp2();
  setup.model.torque_limits = true;
  EXPECT_TRUE(Played(setup, Standing()).stayed_up);
  for (Leg& leg : setup.robot.model.legs) {
    for (LegJoint& joint : leg.joints) joint.max_torque = 1e-3;
  }
  EXPECT_FALSE(Played(setup, Walk()).stayed_up);
  setup.model.torque_limits = false;
  EXPECT_TRUE(Played(setup, Standing()).stayed_up);
}

TEST(ReplayWorlds, ASofterAnkleTiltsMoreAndThenFalls) {
  SKIP_WITHOUT_SIMULATION();
  const ReplayResult rigid = Played(Hrp2(), Walk());
  const ReplayResult bush = Played(Hrp2({1500, 75}), Walk());
  EXPECT_TRUE(bush.stayed_up);
  EXPECT_GT(bush.largest_tilt, 2 * rigid.largest_tilt);
  EXPECT_FALSE(Played(Hrp2({100, 10}), Walk()).stayed_up);
}

TEST(ReplayWorlds, ASlopeLeansTheRobotAndASteepOneFellsIt) {
  SKIP_WITHOUT_SIMULATION();
  ReplaySetup slope = Hrp2();
  slope.relief = ParseRelief("", "slope=3");
  EXPECT_NEAR(Played(slope, Standing()).rows.back().tilt, 3 * kOneDegree, 0.5 * kOneDegree);
  slope.relief = ParseRelief("", "slope=15");
  EXPECT_FALSE(Played(slope, Walk()).stayed_up);
}

TEST(ReplayWorlds, PlatesTiltTheRobot) {
  SKIP_WITHOUT_SIMULATION();
  const std::vector<TrajectoryRow> rows = Walk("fig5_box");
  const ReferenceMotion motion(rows);
  ReplaySetup plates = Hrp2();
  plates.relief = ParseRelief("", "plates=0.02");
  int seed = 1;
  while (DrawWorld(seed, plates, motion).floor.plates.empty()) ++seed;
  const SimulatedFloor floor = DrawWorld(seed, plates, motion).floor;
  ASSERT_EQ(floor.plates.size(), 1u);  // one foot lands
  EXPECT_GT(floor.plates[0].X_FP.translation().z(), 0.0);
  EXPECT_LE(floor.plates[0].X_FP.translation().z(), 0.02);
  const double tilt = Play(plates.Robot(floor), motion, plates.play).largest_tilt;
  EXPECT_GT(tilt, Played(Hrp2(), rows).largest_tilt + 0.2 * kOneDegree);
}

TEST(ReplayWorlds, AFloorThatIsNoneIsRefused) {
  for (const char* text :
       {"", "plates", "plates=", "plates=0.2", "plates=-1", "slope=21", "slope=1,slope=2",
        "plates=0.01,", "hills=1", "plates=nan", "curb=-0.2"}) {
    EXPECT_THAT(
        RefusalOf([&] { ParseRelief("--floor", text); }),
        HasSubstr("is no floor (valid: plates=H with H from 0 to 0.1 m, curb=H with H from"))
        << text;
  }
}

TEST(ReplayCommand, RefusesOptionsThatAreNone) {
  const TemporaryFolder place;
  const std::vector<std::pair<std::vector<std::string>, std::string>> mistakes = {
      {{"--servos", "3000"}, "--servos '3000': is no spring (valid: K,D with K in N m/rad above 0"},
      {{"--servos", "0,1"}, "--servos '0,1': is no spring (valid: "},
      {{"--ankle", "a,b"}, "--ankle 'a,b': is no spring (valid: "},
      {{"--ankle", "1000,50,2"}, "--ankle '1000,50,2': is no spring (valid: "},
      {{"--seeds", "0"}, "--seeds '0': is no number of seeds (valid: 1 … 1000)"},
      {{"--seeds", "1.5"}, "--seeds '1.5': is no number of seeds (valid: 1 … 1000)"},
      {{"--seeds", "2", "--push"}, "--push: looks for the limit in one simulation (valid: "},
  };
  for (const auto& [options, complaint] : mistakes) {
    std::vector<std::string> words = {"replay", "run"};
    words.insert(words.end(), options.begin(), options.end());
    const Outcome outcome = Halfstep(place.path(), words);
    EXPECT_EQ(outcome.status, kBadInput) << options[1];
    EXPECT_THAT(outcome.err, HasSubstr(complaint));
  }
}

std::string FirstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

std::vector<std::string> ShortRun(const std::string& folder, const std::string& set) {
  return {"run",   ShippedConfig("fig3_two_half_steps"), "--out", folder,
          "--set", "smoothing.methods=[dichotomy]",      "--set", set};
}

TEST(RunCommand, TellsHowOftenCertifiedWalksStand) {
  const TemporaryFolder place;
  const Outcome outcome = Halfstep(place.path(), ShortRun("run", "replay.seeds=2"));
  if (!WhyNoSimulation().empty()) {
    EXPECT_EQ(outcome.status, kBadInput);
    EXPECT_THAT(outcome.err, HasSubstr("replay: " + WhyNoSimulation()));
    return;
  }
  ASSERT_EQ(outcome.status, kSuccess) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("stands in 2 of 2, median tilt 0."));
  const ParsedCsv summary(ReadText(place / "run/summary.csv"));
  EXPECT_EQ(summary.Text(1, "stands"), "2 of 2");
  EXPECT_EQ(Halfstep(place.path(), {"verify", "run", "--quiet"}).status, kSuccess);
  const Outcome replay = Halfstep(
      place.path(), {"replay", "run", "--method", "dichotomy", "--seeds", "2", "--json", "--out"});
  ASSERT_EQ(replay.status, kSuccess) << replay.err;
  const auto json = nlohmann::json::parse(replay.out)["methods"][0];
  EXPECT_EQ(json["stands"], 2);
  EXPECT_EQ(json["median"]["largest_tilt_rad"], summary.Number(1, "replay_tilt_rad"));
  EXPECT_EQ(ParsedCsv(ReadText(place / "run/dichotomy/replays.csv")).size(), 2u);
  EXPECT_EQ(Halfstep(place.path(), {"verify", "run", "--quiet"}).status, kSuccess);
}

// Certified all the same, so the run succeeds; the replay does not.
TEST(RunCommand, TellsHowOftenTheyFall) {
  SKIP_WITHOUT_SIMULATION();
  const TemporaryFolder place;
  const Outcome outcome =
      Halfstep(place.path(), ShortRun("run", "replay={seeds: 2, ankle: [100, 10]}"));
  ASSERT_EQ(outcome.status, kSuccess) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("falls in 2 of 2"));
  EXPECT_EQ(ParsedCsv(ReadText(place / "run/summary.csv")).Text(1, "stands"), "0 of 2");
  const Outcome replay = Halfstep(
      place.path(), {"replay", "run", "--seeds", "1", "--ankle", "100,10", "--method", "raw"});
  EXPECT_EQ(replay.status, kFailed);
  EXPECT_THAT(replay.out, HasSubstr("seed 1: FALLS at "));
}

TEST(RunCommand, WritesNothingOfReplaysThatNobodyAskedFor) {
  const TemporaryFolder place;
  ASSERT_EQ(Halfstep(place.path(), ShortRun("run", "seed=1")).status, kSuccess);
  EXPECT_TRUE(FirstLine(ReadText(place / "run/summary.csv")).ends_with(",gap_to_reference"));
  EXPECT_EQ(ReadText(place / "run/config.yaml").find("replay"), std::string::npos);
}

}  // namespace
}  // namespace halfstep::replay
