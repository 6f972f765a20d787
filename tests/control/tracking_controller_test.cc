#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "experiments/commands/commands.h"
#include "experiments/config/data_folder.h"
#include "experiments/config/experiment.h"
#include "experiments/control/dcm_controller.h"
#include "experiments/control/sole_loads.h"
#include "experiments/replay/control_loop.h"
#include "experiments/replay/mujoco_model.h"
#include "experiments/replay/planned_row.h"
#include "experiments/replay/replay.h"
#include "smoothing/walk/superposed_walk.h"
#include "tests/experiments/child_process.h"
#include "tests/refusal_of.h"
#include "tests/temporary_folder.h"
#include "wpg/geometry/rotation.h"
#include "wpg/robot/gravity.h"
#include "wpg/robot/robot_tree.h"

namespace halfstep::control {
namespace {

using replay::ControlLoop;
using replay::MujocoModel;
using replay::PlannedStates;
using replay::PlayOptions;
using replay::ReferenceMotion;
using replay::ReplayResult;
using replay::Simulation;
using testing::HasSubstr;

constexpr double kDegree = M_PI / 180;

/// A controller of a user's own: the plan as it is. Counts its calls, and how late what it gets is.
class PlanItself final : public TrackingController {
 public:
  JointCommand Command(const MeasuredState& measured, const PlannedState& then,
                       const PlannedState& next) override {
    EXPECT_EQ(measured.t, then.t);
    latest_age_ = next.t - measured.t;
    return {next.q, next.speeds};
  }
  std::unique_ptr<TrackingController> Clone() const override {
    return std::make_unique<PlanItself>(*this);
  }
  static double latest_age_;
};
double PlanItself::latest_age_ = 0.0;

/// HRP-2 and two half-steps one after the other, every 5 ms.
class TrackingControllerTest : public testing::Test {
 protected:
  std::vector<TrajectoryRow> Walk() const {
    const Experiment experiment = Prepare(LoadConfig(ShippedConfig("fig3_two_half_steps"), {}));
    const SuperposedWalk walk(experiment.sequence, PlannedMotion(experiment.sequence));
    std::vector<TrajectoryRow> rows;
    for (int i = 0; i <= 800; ++i) {
      rows.push_back(replay::PlannedRow(robot_, walk, 0.005 * i));
    }
    return rows;
  }
  Simulation Robot(double stiffness, double damping,
                   const std::optional<JointSpring>& ankle = {}) const {
    return {MujocoModel(robot_, whole_.tree,
                        {.stiffness = stiffness, .damping = damping, .ankle = ankle}),
            robot_, "WAIST"};
  }
  PlayOptions By(const TrackingController& controller, const SensorOptions& sensors = {}) const {
    PlayOptions options;
    options.control =
        std::make_shared<ControlLoop>(std::make_shared<PlannedStates>(robot_, motion_), controller,
                                      Sensors(sensors, robot_.mass * kGravity));
    return options;
  }
  // What a robot would measure that is exactly where it is planned.
  MeasuredState AsPlanned(const PlannedState& plan) const {
    const Eigen::Vector2d zmp = NearestInSupport(plan, robot_.sole_size, 0.05, plan.zmp);
    return {.t = plan.t,
            .q = plan.q,
            .speeds = plan.speeds,
            .R_WB = plan.X_WB.linear(),
            .loads = SharedLoads(plan, robot_.sole_size, zmp)};
  }
  // Whether the robot is up in the end after a push of so much [N s] to the left at t [s].
  bool Survives(const Simulation& robot, const PlayOptions& options, double t, double push) const {
    replay::Player player(robot, motion_, options);
    while (player.time() < motion_.end() + options.hold) {
      const replay::Push to_left{t, 0.1, {0.0, push, 0.0}};
      if (player.Advance(motion_, to_left).fallen) return false;
    }
    return true;
  }

  const WholeRobot whole_ = LoadWholeRobot((RobotsFolder() / "hrp2.yaml").string());
  const RobotModel& robot_ = whole_.model;
  const ReferenceMotion motion_{Walk()};
};

#define SKIP_WITHOUT_SIMULATION() \
  if (!replay::WhyNoSimulation().empty()) GTEST_SKIP() << replay::WhyNoSimulation()

TEST_F(TrackingControllerTest, WhoIsWhereItIsPlannedIsCommandedThePlan) {
  const PlannedStates plan(robot_, motion_);
  DcmController dcm(robot_, {}), leaning(robot_, {});
  double off = 0.0, off_leaning = 0.0;
  for (double t = 0.0; t < motion_.end(); t += kControlPeriod) {
    const PlannedState then = plan.At(t), next = plan.At(t + kControlPeriod);
    MeasuredState measured = AsPlanned(then);
    const JointCommand command = dcm.Command(measured, then, next);
    measured.R_WB = RollPitchYaw(0.0, 1.0 * kDegree, 0.0) * measured.R_WB;
    const JointCommand other = leaning.Command(measured, then, next);
    for (size_t s = 0; s < 2; ++s) {
      off = std::max(off, (command.q[s] - next.q[s]).cwiseAbs().maxCoeff());
      off_leaning = std::max(off_leaning, (other.q[s] - next.q[s]).cwiseAbs().maxCoeff());
    }
  }
  EXPECT_LT(off, 2e-4);
  EXPECT_GT(off_leaning, 0.01);
}

TEST_F(TrackingControllerTest, LoadsGiveTheForceAtTheZmp) {
  const PlannedStates plan(robot_, motion_);
  for (double t = 0.0; t < motion_.end(); t += 0.1) {
    const PlannedState state = plan.At(t);
    const Eigen::Vector2d zmp = NearestInSupport(state, robot_.sole_size, 0.1, state.zmp);
    Eigen::Vector2d moment(0, 0);
    double force = 0.0;
    const std::array<SoleLoad, 2> loads = SharedLoads(state, robot_.sole_size, zmp);
    for (size_t s = 0; s < 2; ++s) {
      const Eigen::Vector3d centre(loads[s].centre.x(), loads[s].centre.y(), 0.0);
      moment += loads[s].force * (state.X_WSole[s] * centre).head<2>();
      force += loads[s].force;
    }
    EXPECT_NEAR(force, state.force, 1e-9);
    EXPECT_LT((moment / force - zmp).norm(), 1e-9) << t;
  }
}

// Without noise, against the simulator's truth.
TEST_F(TrackingControllerTest, TheEstimateIsWhereTheRobotIs) {
  SKIP_WITHOUT_SIMULATION();
  const PlannedStates plan(robot_, motion_);
  Simulation robot = Robot(30000.0, 1000.0);
  robot.Place(motion_.rows().front().X_WB(), motion_.rows().front().q);
  const double dt = robot.timestep();
  double standing = 0.0, walking = 0.0, speed = 0.0;
  for (int i = -800; i < 8000; ++i) {
    const double t = i * dt;
    const Eigen::Vector3d before = robot.com();
    const MeasuredState measured = robot.Measure();
    robot.Step(motion_.TargetsAt(t + dt), Eigen::Vector3d::Zero());
    if (i % 10 != 0 || i < -200) continue;
    const EstimatedState state = EstimateState(robot_, measured, plan.At(t));
    const double off = (state.com - before).norm();
    (i < 0 ? standing : walking) = std::max(i < 0 ? standing : walking, off);
    speed = std::max(speed, (state.velocity - (robot.com() - before) / dt).norm());
  }
  EXPECT_LT(standing, 0.0005);
  EXPECT_LT(walking, 0.004);
  EXPECT_LT(speed, 0.06);
}

TEST_F(TrackingControllerTest, AControllerOfOnesOwnGetsWhatIsMeasuredAsLateAsTold) {
  SKIP_WITHOUT_SIMULATION();
  const Simulation robot = Robot(30000.0, 1000.0);
  const ReplayResult open = Play(robot, motion_, {});
  const ReplayResult own = Play(robot, motion_, By(PlanItself(), {.delay = 0.012, .seed = {}}));
  EXPECT_NEAR(PlanItself::latest_age_, 0.012 + kControlPeriod, 1e-9);
  EXPECT_NEAR(own.largest_tilt, open.largest_tilt, 1e-6);
  EXPECT_NEAR(own.zmp_rms, open.zmp_rms, 1e-4);
}

TEST_F(TrackingControllerTest, FeedbackHelpsAndTheWrongSignHarms) {
  SKIP_WITHOUT_SIMULATION();
  const Simulation robot = Robot(3000.0, 150.0);
  const auto tilt = [&](double gain) {
    const DcmController dcm(robot_, {.stiffness = 3000.0, .damping = 150.0, .gain = gain});
    return Play(robot, motion_, By(dcm)).largest_tilt;
  };
  const double open = Play(robot, motion_, {}).largest_tilt, right = tilt(3.0);
  EXPECT_LT(right, 0.1 * open);
  EXPECT_GT(tilt(-3.0), 3.0 * right);
}

TEST_F(TrackingControllerTest, FeetOfSoftServosFollowWhenTheirDampingIsKnown) {
  SKIP_WITHOUT_SIMULATION();
  const Simulation robot = Robot(3000.0, 150.0);
  const auto off = [&](const DcmOptions& options) {
    return Play(robot, motion_, By(DcmController(robot_, options))).off;
  };
  EXPECT_LT(off({.stiffness = 3000.0, .damping = 150.0}).largest.foot, 0.002);
  EXPECT_GT(off({.stiffness = 3000.0}).largest.foot, 0.004);
  // Told as twice as stiff: without the integral of joints' errors half of the sag stays.
  const double told = off({.stiffness = 6000.0, .damping = 300.0, .stiffen = 0.0}).most.joint;
  EXPECT_LT(off({.stiffness = 6000.0, .damping = 300.0, .stiffen = 1.0}).most.joint, 0.7 * told);
}

TEST_F(TrackingControllerTest, ABushThatIsKnownLeansLess) {
  SKIP_WITHOUT_SIMULATION();
  const JointSpring bush{1000.0, 50.0};
  const Simulation robot = Robot(30000.0, 1000.0, bush);
  const auto play = [&](const std::optional<JointSpring>& ankle, double gain) {
    const DcmController dcm(
        robot_, {.stiffness = 30000.0, .damping = 1000.0, .ankle = ankle, .gain = gain});
    return Play(robot, motion_, By(dcm));
  };
  const ReplayResult known = play(bush, 3.0);
  EXPECT_TRUE(known.stayed_up);
  EXPECT_LT(known.largest_tilt, 0.5 * kDegree);
  EXPECT_GT(play({}, 3.0).largest_tilt, 2.0 * known.largest_tilt);
  EXPECT_FALSE(play(bush, -3.0).stayed_up);
  EXPECT_GT(play(JointSpring{400.0, 20.0}, 3.0).largest_tilt, 2.0 * known.largest_tilt);
}

TEST_F(TrackingControllerTest, SurvivesAPushThatTheOpenLoopDoesNot) {
  SKIP_WITHOUT_SIMULATION();
  constexpr double kAt = 1.0, kPush = 16.8;
  const Simulation robot = Robot(3000.0, 150.0);
  EXPECT_FALSE(Survives(robot, {}, kAt, kPush));
  EXPECT_TRUE(Survives(robot, By(DcmController(robot_, {.stiffness = 3000.0, .damping = 150.0})),
                       kAt, kPush));
}

TEST_F(TrackingControllerTest, TheSameNoiseGivesTheSameMotion) {
  SKIP_WITHOUT_SIMULATION();
  const Simulation robot = Robot(10000.0, 300.0);
  const DcmController dcm(robot_, {.stiffness = 10000.0, .damping = 300.0});
  const auto played = [&](std::uint64_t seed) {
    return Play(robot, motion_, By(dcm, {.seed = seed}));
  };
  const ReplayResult first = played(1), again = played(1), other = played(2);
  ASSERT_EQ(first.rows.size(), again.rows.size());
  EXPECT_TRUE(first.stayed_up);
  EXPECT_EQ(ReplayCsv(first.rows).text, ReplayCsv(again.rows).text);
  EXPECT_NE(ReplayCsv(first.rows).text, ReplayCsv(other.rows).text);
}

TEST(ReplayCommandControllers, AProgramAddsItsOwnAndMistakesAreTold) {
  const TemporaryFolder place;
  const std::string run = (place / "run").string();
  ASSERT_EQ(halfstep::Run({.config = ShippedConfig("fig3_two_half_steps"),
                           .methods = {},
                           .overrides = {},
                           .out = run,
                           .quiet = true}),
            kSuccess);
  ReplayCommand command;
  command.run = run;
  command.method = "raw";
  command.quiet = true;
  command.simulated.controllers.Add(
      "mine", [](const ControlledRobot&) { return std::make_unique<PlanItself>(); });
  EXPECT_THROW(command.simulated.controllers.Add("mine", {}), std::logic_error);
  const auto refused = [&command] { Replay(command); };
  command.simulated.sensor_delay = 0.01;
  EXPECT_THAT(RefusalOf(refused), HasSubstr("--sensor-delay: without a --controller"));
  command.simulated.controller = "yours";
  EXPECT_THAT(RefusalOf(refused),
              HasSubstr("--controller: there is no yours (valid: none, dcm, mine)"));
  command.simulated.controller = "mine";
  command.simulated.sensor_delay = -1.0;
  EXPECT_THAT(RefusalOf(refused), HasSubstr("--sensor-delay -1: no delay (valid: 0 … 1 s)"));
  command.simulated.sensor_delay = 0.01;
  SKIP_WITHOUT_SIMULATION();
  EXPECT_EQ(Replay(command), kSuccess);
  EXPECT_NEAR(PlanItself::latest_age_, 0.01 + kControlPeriod, 1e-9);
}

}  // namespace
}  // namespace halfstep::control
