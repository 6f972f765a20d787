#include "experiments/control/dcm_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "experiments/config/data_folder.h"
#include "experiments/config/experiment.h"
#include "experiments/control/push_watch.h"
#include "experiments/control/sole_loads.h"
#include "experiments/replay/mujoco_model.h"
#include "experiments/replay/planned_row.h"
#include "experiments/replay/planned_states.h"
#include "experiments/replay/seeded_replay.h"
#include "smoothing/walk/superposed_walk.h"
#include "tests/experiments/child_process.h"
#include "wpg/geometry/rotation.h"
#include "wpg/robot/gravity.h"
#include "wpg/robot/robot_tree.h"

namespace halfstep::control {
namespace {

using replay::MujocoModel;
using replay::PlannedStates;
using replay::ReferenceMotion;
using replay::Simulation;

constexpr double kNoFilter = 0.0;

/// HRP-2 and two half-steps one after the other, every 5 ms.
class DcmErrorTest : public testing::Test {
 protected:
  std::vector<TrajectoryRow> Walk() const {
    const Experiment experiment = Prepare(LoadConfig(ShippedConfig("fig3_two_half_steps"), {}));
    const SuperposedWalk walk(experiment.sequence, PlannedMotion(experiment.sequence));
    std::vector<TrajectoryRow> rows;
    for (int i = 0; i <= 800; ++i) rows.push_back(replay::PlannedRow(robot_, walk, 0.005 * i));
    return rows;
  }

  // The plan at an instant of single support, as if it rested there, and one who is on it.
  PlannedState Still() const {
    PlannedState then = plan_.At(1.4);
    then.com_velocity.setZero();
    then.ankle_moments = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    return then;
  }
  MeasuredState On(const PlannedState& then) const {
    MeasuredState measured;
    measured.t = then.t;
    measured.q = then.q;
    measured.R_WB = then.X_WB.linear();
    measured.speeds = {Vector6d::Zero(), Vector6d::Zero()};
    measured.loads = SharedLoads(then, robot_.sole_size, then.zmp);
    return measured;
  }
  // Leans it forward. The pressure is where the moment about the ankle turns the bush by as much.
  static void Lean(double angle, MeasuredState* measured) {
    measured->R_WB = RollPitchYaw(0.0, angle, 0.0) * measured->R_WB;
  }
  static void Press(double angle, const JointSpring& bush, SoleLoad* load) {
    load->centre.x() += bush.stiffness * angle / load->force;
  }

  const WholeRobot whole_ = LoadWholeRobot((RobotsFolder() / "hrp2.yaml").string());
  const RobotModel& robot_ = whole_.model;
  const ReferenceMotion motion_{Walk()};
  const PlannedStates plan_{robot_, motion_};
};

// About the point that rests, the height of the CoM times the lean; with a bush that gives way by
// as much, about the ankle instead.
TEST_F(DcmErrorTest, IsHowFarALeanPutsTheCom) {
  constexpr double kLean = 0.01;  // [rad]
  const JointSpring bush{1000.0, 50.0};
  const PlannedState still = Still();
  ASSERT_NE(still.stands[0], still.stands[1]);
  const size_t s = still.stands[0] ? 0 : 1;
  MeasuredState measured = On(still);
  DcmError upright(robot_, {}, kNoFilter), leaning(robot_, {}, kNoFilter);
  upright.Sense(measured, still, kControlPeriod);
  EXPECT_LT(upright.value().norm(), 0.001);

  Lean(kLean, &measured);
  leaning.Sense(measured, still, kControlPeriod);
  EXPECT_NEAR((leaning.value() - upright.value()).x(), kLean * still.com.z(), 2e-4);

  DcmError yielding(robot_, bush, kNoFilter);
  Press(kLean, bush, &measured.loads[s]);
  for (int i = 0; i < 200; ++i) yielding.Sense(measured, still, kControlPeriod);
  const AnkleBush at(robot_.legs[s], bush);
  const double ankle = at.ankle().z();
  EXPECT_GT(ankle, 0.05);
  EXPECT_NEAR((yielding.value() - upright.value()).x(), kLean * (still.com.z() - ankle), 3e-4);
}

// A lean that puts the CoM a quarter of the sole's length off above a rigid ankle, and not quite as
// far off where the ankle's bush gave way.
TEST_F(DcmErrorTest, APushIsToldOnceAndABushThatGivesWayIsNone) {
  const JointSpring bush{300.0, 15.0};
  const PlannedState still = Still();
  const double lean = 1.05 * PushWatch::kPushed * robot_.sole_size.x() / still.com.z();  // [rad]
  MeasuredState upright = On(still), leaning = upright;
  Lean(lean, &leaning);
  Press(lean, bush, &leaning.loads[still.stands[0] ? 0 : 1]);
  const auto told = [&](PushWatch* watch, const MeasuredState& measured) {
    std::vector<double> all;  // how far off [m]
    for (int i = 0; i < 200; ++i) {
      if (const auto off = watch->Look(measured, still, kControlPeriod)) all.push_back(*off);
    }
    return all;
  };
  replay::ReplaySetup setup;  // as episodes in physics know it
  setup.robot = whole_;
  setup.model.ankle = bush;
  PushWatch known(setup.Controlled()), rigid({.model = robot_, .servos = {}});
  EXPECT_TRUE(told(&known, leaning).empty());
  EXPECT_FALSE(known.pushed());

  EXPECT_TRUE(told(&rigid, upright).empty());
  const std::vector<double> off = told(&rigid, leaning);
  ASSERT_EQ(off.size(), 1u);
  EXPECT_NEAR(off[0], PushWatch::kPushed * robot_.sole_size.x(), 0.003);
  EXPECT_TRUE(rigid.pushed());
  EXPECT_TRUE(told(&rigid, upright).empty());
  EXPECT_FALSE(rigid.pushed());
}

// Against the simulator's truth, while the robot is pushed forward.
TEST_F(DcmErrorTest, ABushThatIsKnownIsSeen) {
  if (!replay::WhyNoSimulation().empty()) GTEST_SKIP() << replay::WhyNoSimulation();
  const JointSpring bush{1000.0, 50.0};
  Simulation robot(
      MujocoModel(robot_, whole_.tree, {.stiffness = 30000.0, .damping = 1000.0, .ankle = bush}),
      robot_, "WAIST");
  robot.Place(motion_.rows().front().X_WB(), motion_.rows().front().q);
  DcmError known(robot_, bush, kNoFilter), unknown(robot_, {}, kNoFilter);
  const double dt = robot.timestep(), omega = std::sqrt(kGravity / robot_.com_height);
  double off_known = 0.0, off_unknown = 0.0;
  for (int i = -800; i < 4000; ++i) {
    const double t = i * dt;
    const Eigen::Vector3d before = robot.com();
    MeasuredState measured = robot.Measure();
    measured.t = t;
    const double push = t > 1.2 && t < 1.3 ? 80.0 : 0.0;  // [N]
    robot.Step(motion_.TargetsAt(t + dt), {push, 0.0, 0.0});
    if (i % 10 != 0) continue;
    const PlannedState then = plan_.At(t);
    known.Sense(measured, then, kControlPeriod);
    unknown.Sense(measured, then, kControlPeriod);
    if (i < 0) continue;
    const Eigen::Vector3d velocity = (robot.com() - before) / dt;
    const Eigen::Vector3d off = before - then.com + (velocity - then.com_velocity) / omega;
    off_known = std::max(off_known, (known.value() - off.head<2>()).norm());
    off_unknown = std::max(off_unknown, (unknown.value() - off.head<2>()).norm());
  }
  EXPECT_GT(off_unknown, 0.004);
  EXPECT_LT(off_known, 0.6 * off_unknown);
}

}  // namespace
}  // namespace halfstep::control
