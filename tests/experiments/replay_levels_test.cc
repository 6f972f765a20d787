#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "experiments/config/data_folder.h"
#include "experiments/config/experiment.h"
#include "experiments/control/dcm_controller.h"
#include "experiments/control/sole_loads.h"
#include "experiments/replay/foot_body.h"
#include "experiments/replay/mass_model_zmp.h"
#include "experiments/replay/planned_row.h"
#include "experiments/replay/planned_states.h"
#include "experiments/replay/run_replay.h"
#include "experiments/replay/simulated_robot.h"
#include "smoothing/walk/superposed_walk.h"
#include "tests/experiments/child_process.h"
#include "tests/refusal_of.h"
#include "wpg/nth.h"

namespace halfstep::replay {
namespace {

using control::PlannedState;
using control::SoleLoad;
using testing::AnyOf;
using testing::HasSubstr;
using testing::IsEmpty;

#define SKIP_WITHOUT_SIMULATION() \
  if (!WhyNoSimulation().empty()) GTEST_SKIP() << WhyNoSimulation()

// A prism with its top at `top`, and this outline seen from above.
GroundSolid Prism(const Eigen::Matrix2Xd& polygon, double top) {
  return {.name = "prism", .polygon = polygon, .top = top, .bottom = top - 0.1, .bears = 0};
}

GroundSolid Block(double x, double y, double length, double width, double top) {
  Eigen::Matrix2Xd polygon(2, 4);
  polygon << x, x + length, x + length, x, y, y, y + width, y + width;
  return Prism(polygon, top);
}

// A regular polygon of so many corners about the origin.
GroundSolid Regular(int corners, double radius, double top) {
  Eigen::Matrix2Xd polygon(2, corners);
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * M_PI * i / corners;
    polygon.col(i) << radius * std::cos(angle), radius * std::sin(angle);
  }
  return Prism(polygon, top);
}

/// HRP-2 and the walk of a shipped config as planned, one half-step after the other.
class ReplayLevelsTest : public testing::Test {
 protected:
  // Of its first `seconds`, every 5 ms.
  std::vector<TrajectoryRow> Walk(const std::string& config, double seconds) const {
    const Experiment experiment = Prepare(LoadConfig(ShippedConfig(config), {}));
    const SuperposedWalk walk(experiment.sequence, PlannedMotion(experiment.sequence));
    std::vector<TrajectoryRow> rows;
    for (int i = 0; i <= std::lround(seconds / 0.005); ++i) {
      rows.push_back(PlannedRow(whole_.model, walk, 0.005 * i));
    }
    FindZmpPlanes(whole_.model, &rows);
    return rows;
  }
  // At rest, with both soles this high.
  std::vector<TrajectoryRow> Standing(double height) const {
    TrajectoryRow row = Walk("fig3_two_half_steps", 0.0).front();
    row.waist.z() += height;
    for (Eigen::Vector4d& sole : row.soles) sole.z() += height;
    std::vector<TrajectoryRow> rows(2, row);
    rows[1].t = 0.2;
    FindZmpPlanes(whole_.model, &rows);
    return rows;
  }
  ReplaySetup SetupOn(const SimulatedGround& ground) const {
    ReplaySetup setup = SetupOf(whole_, {.obstacles = {}, .notes = {}, .ground = ground}, {});
    setup.play.settle = setup.play.hold = 0.2;
    return setup;
  }
  static ReplayResult Played(const ReplaySetup& setup, const std::vector<TrajectoryRow>& rows) {
    const ReferenceMotion motion(rows);
    const Simulation robot = setup.Robot(DrawWorld(1, setup, motion).floor);
    return Play(robot, motion, setup.PlayOf(robot, motion));
  }
  static SimulatedGround GroundOf(const std::string& config) {
    return ObstaclesOf(Prepare(LoadConfig(ShippedConfig(config), {})).scene).ground;
  }

  const WholeRobot whole_ = LoadWholeRobot((RobotsFolder() / "hrp2.yaml").string());
};

// Boxes, and prisms that MuJoCo has as meshes.
TEST_F(ReplayLevelsTest, WhatStandsOnASolidTouchesNothingElse) {
  SKIP_WITHOUT_SIMULATION();
  for (const double top : {0.3, -0.2}) {
    for (const GroundSolid& solid : {Block(-1, -1, 2, 2, top), Regular(6, 0.5, top)}) {
      const ReplayResult result =
          Played(SetupOn({.floor = false, .solids = {solid}}), Standing(top));
      EXPECT_TRUE(result.stayed_up);
      EXPECT_NEAR(result.weight_share, 1.0, 0.01);
      EXPECT_LT(result.largest_tilt, 0.3 * (M_PI / 180));
      EXPECT_LT(result.zmp_largest, solid.polygon.cols() == 4 ? 0.005 : 0.03);  // fewer contacts
      EXPECT_THAT(result.touches, IsEmpty());
      EXPECT_GT(result.rows.back().edge, 0.05);
    }
  }
}

// A sole on either of two abutting solids.
TEST_F(ReplayLevelsTest, SeamsOfALevelAreNoEdges) {
  SKIP_WITHOUT_SIMULATION();
  const SimulatedGround ground{.floor = false,
                               .solids = {Block(-1, -1, 1.02, 2, 0.1), Block(0.02, -1, 1, 2, 0.1)}};
  const ReplayResult result = Played(SetupOn(ground), Standing(0.1));
  EXPECT_TRUE(result.stayed_up);
  EXPECT_LT(result.largest_tilt, 0.3 * (M_PI / 180));
  EXPECT_THAT(result.touches, IsEmpty());
}

TEST_F(ReplayLevelsTest, WhoHasNothingUnderTheSolesHasFallen) {
  SKIP_WITHOUT_SIMULATION();
  std::vector<TrajectoryRow> rows = Standing(0.0);
  rows[1].t = 2.0;
  const ReplayResult result =
      Played(SetupOn({.floor = false, .solids = {Block(2, -1, 1, 2, 0.0)}}), rows);
  EXPECT_FALSE(result.stayed_up);
  EXPECT_LT(result.ended, 0.5);
  EXPECT_LT(result.largest_tilt, 10 * (M_PI / 180));
}

// The first step up. Of treads that are 16 cm higher than planned the foot meets the riser.
TEST_F(ReplayLevelsTest, AStepStandsAndARiserInTheWayIsTold) {
  SKIP_WITHOUT_SIMULATION();
  const std::vector<TrajectoryRow> rows = Walk("stairs_10cm", 4.0);
  SimulatedGround ground = GroundOf("stairs_10cm");
  const ReplayResult result = Played(SetupOn(ground), rows);
  EXPECT_TRUE(result.stayed_up);
  EXPECT_LT(result.largest_tilt, 0.5 * (M_PI / 180));
  EXPECT_THAT(result.touches, IsEmpty());
  EXPECT_NEAR(result.rows.back().waist.z(), rows.back().waist.z(), 0.003);
  for (GroundSolid& solid : ground.solids) solid.top += 0.16;
  EXPECT_FALSE(Played(SetupOn(ground), rows).touches.empty());
}

// A block 8 mm high against the tip of the left sole, and one against the shin.
TEST_F(ReplayLevelsTest, SidesOfSolidsAreTouchedBySolesAndShins) {
  SKIP_WITHOUT_SIMULATION();
  const RobotModel& robot = whole_.model;
  const auto touches = [&](const GroundSolid& solid) {
    const ReplaySetup setup = SetupOn({.floor = true, .solids = {solid}});
    Simulation simulation = setup.Robot(DrawWorld(1, setup, ReferenceMotion(Standing(0.0))).floor);
    const TrajectoryRow row = Standing(0.0).front();
    simulation.Place(row.X_WB(), row.q);
    return simulation.touches();
  };
  const Eigen::Vector2d left = Walk("fig3_two_half_steps", 0.0).front().soles[0].head<2>();
  const double tip = left.x() + 0.5 * robot.sole_size.x();
  const std::vector<Touch> of_sole = touches(Block(tip - 0.001, left.y() - 0.05, 0.1, 0.1, 0.008));
  ASSERT_EQ(of_sole.size(), 1u);
  EXPECT_EQ(of_sole[0].body, static_cast<int>(robot.bodies.size()));
  EXPECT_EQ(of_sole[0].obstacle, 0);
  EXPECT_THAT(touches(Block(tip + 0.005, left.y() - 0.05, 0.1, 0.1, 0.008)), IsEmpty());
  GroundSolid at_shin = Block(left.x() - 0.05, left.y() - 0.05, 0.1, 0.1, 0.3);
  at_shin.bottom = 0.25;
  const std::vector<Touch> of_shin = touches(at_shin);
  ASSERT_FALSE(of_shin.empty());
  EXPECT_EQ(Nth(robot.bodies, of_shin[0].body).leg, 0);
}

TEST_F(ReplayLevelsTest, FeetAreCutAboveTheirSoles) {
  const Eigen::Isometry3d lower(Eigen::Translation3d(0.0, 0.0, 0.03));
  const auto box = AboveSole(MakeBox({0.2, 0.1, 0.1}), lower, 0.01);
  ASSERT_TRUE(box);
  EXPECT_NEAR(Support(*box, -Eigen::Vector3d::UnitZ()), 0.02, 1e-12);
  EXPECT_NEAR(Support(*box, Eigen::Vector3d::UnitZ()), 0.05, 1e-12);
  EXPECT_NEAR(Support(*box, Eigen::Vector3d::UnitX()), 0.1, 1e-12);
  const auto capsule = AboveSole(MakeCapsule(0.02, 0.1), lower, 0.01);
  ASSERT_TRUE(capsule);
  EXPECT_NEAR(Support(*capsule, -Eigen::Vector3d::UnitZ()), 0.02, 1e-12);
  EXPECT_FALSE(AboveSole(MakeSphere(0.02), lower, 0.04));
  EXPECT_FALSE(AboveSole(MakeBox({0.2, 0.1, 0.1}), lower, 0.08));
  const ConvexBody high = MakeBox({0.2, 0.1, 0.02});
  EXPECT_EQ(AboveSole(high, lower, 0.019)->vertices, high.vertices);
}

// What soles get is a force along the planned one, on the line through its ZMPs. That of a plane
// beside is none.
TEST_F(ReplayLevelsTest, LoadsOnTwoLevelsGiveTheForceOnItsLine) {
  const PlannedStates plan(whole_.model, ReferenceMotion(Walk("stairs_10cm", 8.0)));
  double unequal = 0.0, beside = 0.0;
  for (double t = 0.0; t < 8.0; t += 0.05) {
    const PlannedState state = plan.At(t);
    Eigen::Vector2d moment(0, 0);
    double force = 0.0;
    const std::array<SoleLoad, 2> loads = SharedLoads(state, whole_.model.sole_size, state.zmp);
    for (size_t s = 0; s < 2; ++s) {
      const Eigen::Vector3d centre(loads[s].centre.x(), loads[s].centre.y(), 0.0);
      const Eigen::Vector3d place = state.X_WSole[s] * centre;
      moment += loads[s].force * (place.head<2>() + (state.zmp_height - place.z()) * state.tilt);
      force += loads[s].force;
    }
    EXPECT_NEAR(force, state.force, 1e-9) << t;
    EXPECT_LT((moment / force - state.zmp).norm(), 1e-9) << t;
    if (!state.stands[0] || !state.stands[1]) continue;
    unequal = std::max(unequal, std::abs(state.levels[1] - state.levels[0]));
    beside = std::max(beside, state.zmp_height * state.tilt.norm());
  }
  EXPECT_NEAR(unequal, 0.1, 1e-9);
  EXPECT_GT(beside, 0.002);
}

// The planned ZMP of a certified plan is inside; with the soles taken as at one height it may not
// be.
TEST_F(ReplayLevelsTest, ThePlannedZmpIsInTheShadowsOfTheSoles) {
  const PlannedStates plan(whole_.model, ReferenceMotion(Walk("stairs_10cm", 8.0)));
  double off = 0.0, without = 0.0;
  for (double t = 0.0; t < 8.0; t += 0.01) {
    PlannedState state = plan.At(t);
    const auto nearest = [&] {
      return control::NearestInSupport(state, whole_.model.sole_size, 0.0, state.zmp);
    };
    const Eigen::Vector2d in = nearest();
    off = std::max(off, (in - state.zmp).norm());
    const Eigen::Vector2d far = state.zmp + Eigen::Vector2d(1.0, 0.3);
    const Eigen::Vector2d edge = control::NearestInSupport(state, whole_.model.sole_size, 0.0, far);
    state.tilt.setZero();
    without = std::max(
        without,
        (control::NearestInSupport(state, whole_.model.sole_size, 0.0, far) - edge).norm());
  }
  EXPECT_EQ(off, 0.0);
  EXPECT_GT(without, 0.001);
}

// Heights above where feet land, so that a foot on its way down the stairs has not landed.
TEST_F(ReplayLevelsTest, WhoIsWhereItIsPlannedOnLevelsIsCommandedThePlan) {
  for (const std::string config : {"stairs_10cm", "stairs_10cm_down"}) {
    const PlannedStates plan(whole_.model, ReferenceMotion(Walk(config, 8.0)));
    control::DcmController dcm(whole_.model, {});
    double off = 0.0;
    for (double t = 0.0; t < 8.0; t += control::kControlPeriod) {
      const PlannedState then = plan.At(t), next = plan.At(t + control::kControlPeriod);
      const Eigen::Vector2d zmp = NearestInSupport(then, whole_.model.sole_size, 0.05, then.zmp);
      const control::MeasuredState measured{
          .t = then.t,
          .q = then.q,
          .speeds = then.speeds,
          .R_WB = then.X_WB.linear(),
          .loads = SharedLoads(then, whole_.model.sole_size, zmp)};
      const control::JointCommand command = dcm.Command(measured, then, next);
      for (size_t s = 0; s < 2; ++s) {
        off = std::max(off, (command.q[s] - next.q[s]).cwiseAbs().maxCoeff());
      }
    }
    EXPECT_LT(off, 5e-4) << config;
  }
}

// At rest on one foot at 10 cm the mass model's ZMP is below its CoM in every plane.
TEST_F(ReplayLevelsTest, TheMassModelsZmpIsInThePlaneOfThePlanned) {
  const std::vector<TrajectoryRow> rows = Walk("stairs_10cm", 8.0);
  const std::vector<Eigen::Vector2d> zmp = MassModelZmp(whole_.model, whole_.tree, rows);
  double off = 0.0, largest = 0.0;
  for (size_t i = 0; i < rows.size(); ++i) {
    off = std::max(off, (zmp[i] - rows[i].zmp).norm());
    largest = std::max(largest, std::abs(rows[i].zmp_z));
  }
  EXPECT_LT(off, 0.05);
  EXPECT_NEAR(rows.back().zmp_z, 0.2, 0.11);
  EXPECT_GT(largest, 0.1);
}

TEST_F(ReplayLevelsTest, PlatesAndCurbsAreRefusedAndSlopesTurnAll) {
  const SimulatedObstacles stairs{.obstacles = {}, .notes = {}, .ground = GroundOf("stairs_10cm")};
  for (const std::string floor : {"plates=0.01", "slope=1,curb=0.01"}) {
    EXPECT_THAT(
        RefusalOf([&] { SimulatedRobot{.robot = {}, .floor = floor}.SetupOf(whole_, stairs); }),
        HasSubstr("plates and curbs are of the flat floor"))
        << floor;
  }
  SKIP_WITHOUT_SIMULATION();
  ReplaySetup setup = SetupOn({.floor = false, .solids = {Block(-1, -1, 2, 2, 0.2)}});
  setup.relief = ParseRelief("", "slope=3");
  const ReplayResult result = Played(setup, Standing(0.2));
  EXPECT_TRUE(result.stayed_up);
  EXPECT_NEAR(result.rows.back().tilt, 3 * (M_PI / 180), 0.5 * (M_PI / 180));
}

}  // namespace
}  // namespace halfstep::replay
