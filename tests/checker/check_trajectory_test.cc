// What is proved of a trajectory holds between its knots, and what is not has its instant.
#include "experiments/checker/check_trajectory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "experiments/checker/separation.h"
#include "tests/checker/found_in_check.h"
#include "tests/checker/three_joint_arm.h"
#include "tests/refusal_of.h"
#include "wpg/geometry/rotation.h"

namespace halfstep::checker {
namespace {

using testing::HasSubstr;
using Kind = TrajectoryFinding::Kind;

Scene WithBall(const Eigen::Vector3d& at, double radius) {
  Scene scene;
  Obstacle ball{.name = "ball", .shape = Sphere{radius}};
  ball.X_WO.translation() = at;
  scene.obstacles = {ball};
  return scene;
}

TEST(JointedRobot, FramesHoldThoseOfTheUrdf) {
  const JointedRobot arm = Arm();
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> angle(-2.5, 2.5);
  for (int i = 0; i < 300; ++i) {
    std::vector<double> q = {angle(random), angle(random), angle(random)};
    std::vector<Interval> around;
    for (const double x : q) around.push_back(i % 2 ? Interval(x) : Interval(x - 1e-3, x + 1e-3));
    const std::vector<Frame> frames = arm.Frames(Frame(), around);
    const std::vector<Eigen::Isometry3d> poses = arm.urdf().LinkPoses(q);
    for (size_t link = 0; link < poses.size(); ++link) {
      for (size_t k = 0; k < 3; ++k) {
        const double p = poses[link].translation()[static_cast<Eigen::Index>(k)];
        EXPECT_LE(frames[link].p[k].lo, p + 1e-15);
        EXPECT_GE(frames[link].p[k].hi, p - 1e-15);
        EXPECT_LT(frames[link].p[k].hi - frames[link].p[k].lo, i % 2 ? 1e-13 : 0.02);
      }
    }
  }
}

// A point of the hand, as seen from the base, goes no farther than joints' turns times levers.
TEST(JointedRobot, LeversBoundHowFarBodiesMove) {
  const JointedRobot arm = Arm();
  const JointedRobot::Body& hand = arm.bodies().back();
  const std::vector<JointedRobot::Lever> levers = arm.Levers(hand, 0, {0, 0, 0});
  ASSERT_EQ(levers.size(), 3U);
  EXPECT_NEAR(levers[0].reach, 0.14, 1e-9);  // from the wrist: 0.1 and the ball
  EXPECT_NEAR(levers[2].reach, 0.14 + 0.3 + 0.4, 1e-9);
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> angle(-2.0, 2.0), turn(-0.3, 0.3);
  double tightest = 1.0;
  for (int i = 0; i < 2000; ++i) {
    std::vector<double> q(3), other(3);
    double most = 0.0;
    for (size_t j = 0; j < 3; ++j) {
      q[j] = angle(random);
      other[j] = q[j] + turn(random);
    }
    for (const auto& lever : levers) {
      const auto j = static_cast<size_t>(lever.joint);
      most += std::abs(other[j] - q[j]) * lever.reach;
    }
    const Eigen::Vector3d far = hand.shape.center + Eigen::Vector3d(hand.shape.radius, 0, 0);
    const double moved =
        (arm.urdf().LinkPoses(q)[3] * far - arm.urdf().LinkPoses(other)[3] * far).norm();
    EXPECT_LE(moved, most);
    tightest = std::min(tightest, 1.0 - moved / most);
  }
  EXPECT_LT(tightest, 0.1);
  EXPECT_TRUE(arm.Levers(arm.bodies().front(), 0, {0, 0, 0}).empty());
}

TEST(Separation, GapsAreBelowTheDistanceAndNearIt) {
  const ConvexBody box = MakeBox({0.2, 0.1, 0.1}), ball = MakeSphere(0.05),
                   rod = MakeCylinder(0.03, 0.4);
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  for (int i = 0; i < 300; ++i) {
    Eigen::Isometry3d X_WA = Eigen::Isometry3d::Identity(), X_WB = X_WA;
    X_WA.linear() = RollPitchYaw(share(random), share(random), 3 * share(random));
    X_WB.linear() = RollPitchYaw(share(random), share(random), 3 * share(random));
    X_WB.translation() << 0.5 + 0.1 * share(random), 0.3 * share(random), 0.3 * share(random);
    // Of a ball the distance is that of its centre from the box.
    const Eigen::Vector3d c = X_WA.inverse() * X_WB.translation();
    const Eigen::Vector3d beyond = (c.cwiseAbs() - Eigen::Vector3d(0.1, 0.05, 0.05)).cwiseMax(0.0);
    const double truth = beyond.norm() - 0.05;
    const SeparationHint hint = HintOf(box, X_WA, ball, X_WB);
    const double gap = GapAlong(hint.direction, box, FrameOf(X_WA), ball, FrameOf(X_WB));
    EXPECT_LE(gap, truth);
    EXPECT_GT(gap, truth - 1e-8);
    // Along any other direction it is less; a rod against itself far away keeps its place.
    EXPECT_LE(GapAlong(Eigen::Vector3d::UnitX(), box, FrameOf(X_WA), ball, FrameOf(X_WB)), truth);
    const SeparationHint rods = HintOf(rod, X_WA, rod, X_WB);
    EXPECT_NEAR(GapAlong(rods.direction, rod, FrameOf(X_WA), rod, FrameOf(X_WB)), rods.distance,
                1e-8);
  }
}

// Both knots are clear of the ball, and the hand goes through it.
TEST(CheckTrajectory, ATouchBetweenKnotsIsFound) {
  const Trajectory swing = ArmTrajectory({{0, -1, 0, 0}, {2, 1, 0, 0}});
  const Scene in_the_way = WithBall({0.9, 0, 0}, 0.05), beside = WithBall({0.9, 0, 0.4}, 0.05);
  const TrajectoryCheck touched = CheckTrajectory(swing, Arm(), in_the_way, {});
  EXPECT_FALSE(touched.proved());
  const TrajectoryFinding& hand = FoundIn(touched, Kind::kClearance, "hand - ball");
  EXPECT_FALSE(hand.proved);
  EXPECT_LT(hand.least, 0.0);
  EXPECT_GT(hand.at_knots.value(), 0.3);
  EXPECT_TRUE(CheckTrajectory(swing, Arm(), beside, {}).proved());
}

// The distance that is asked for decides, to a micrometre.
TEST(CheckTrajectory, ProvesWhatIsKeptAndNoMore) {
  const Trajectory swing = ArmTrajectory({{0, -1, 0, 0}, {2, 1, 0, 0}});
  const Scene above = WithBall({0.9, 0, 0.2}, 0.05);  // the hand's centre passes at 0.2 m
  for (const auto& [asked, proved] : {std::pair{0.109999, true}, {0.110001, false}}) {
    const TrajectoryCheck check = CheckTrajectory(swing, Arm(), above, {.clearance = asked});
    EXPECT_EQ(FoundIn(check, Kind::kClearance, "hand - ball").proved, proved) << asked;
    EXPECT_LT(check.intervals, 4000);
  }
}

TEST(CheckTrajectory, ACurveMayLeaveLimitsThatItsKnotsKeep) {
  Trajectory over = ArmTrajectory({{0, 2.4, 0, 0}, {1, 2.4, 0, 0}});
  over.interpolation = Interpolation::kCubic;
  over.v.setZero(3, 2);
  EXPECT_TRUE(CheckTrajectory(over, Arm(), {}, {}).proved());
  over.v(0, 0) = 1.0;  // up, and back
  over.v(0, 1) = -1.0;
  const TrajectoryCheck check = CheckTrajectory(over, Arm(), {}, {});
  const TrajectoryFinding& shoulder = FoundIn(check, Kind::kLimits, "shoulder");
  EXPECT_FALSE(shoulder.proved);
  EXPECT_NEAR(shoulder.at, 0.5, 1e-3);
  EXPECT_NEAR(shoulder.least, 2.5 - 2.65, 1e-3);
  EXPECT_NEAR(shoulder.at_knots.value(), 0.1, 1e-9);
  EXPECT_TRUE(FoundIn(check, Kind::kSpeed, "shoulder").proved);
}

TEST(CheckTrajectory, LinearPiecesHaveSpeedsAndNoAccelerations) {
  const Trajectory fast = ArmTrajectory({{0, 0, 0, 0}, {0.1, 0.31, 0.29, 0}, {1, 0.31, 0.29, 0}});
  const TrajectoryCheck check = CheckTrajectory(fast, Arm(), {}, {.acceleration = 100.0});
  EXPECT_FALSE(FoundIn(check, Kind::kSpeed, "shoulder").proved);
  EXPECT_TRUE(FoundIn(check, Kind::kSpeed, "elbow").proved);
  EXPECT_FALSE(FoundIn(check, Kind::kAcceleration, "elbow").proved);
  EXPECT_EQ(FoundIn(check, Kind::kAcceleration, "elbow").at, 0.1);
  EXPECT_TRUE(FoundIn(check, Kind::kAcceleration, "wrist").proved);
}

// The elbow ends at its limit to the bit, and the hand 22 mm from the upper arm.
TEST(CheckTrajectory, TheHandMayComeNearTheUpperArm) {
  const Trajectory fold = ArmTrajectory({{0, 0, 0, 0}, {1, 0, 2.5, 2.4}});
  EXPECT_TRUE(CheckTrajectory(fold, Arm(), {}, {.self_clearance = 0.021}).proved());
  const TrajectoryCheck check = CheckTrajectory(fold, Arm(), {}, {.self_clearance = 0.03});
  EXPECT_FALSE(FoundIn(check, Kind::kSelfClearance, "upper - hand").proved);
  EXPECT_NEAR(FoundIn(check, Kind::kSelfClearance, "upper - hand").at, 1.0, 0.05);
  const TrajectoryCheck without =
      CheckTrajectory(fold, Arm(), {}, {.self_clearance = 0.03, .ignored = {{"hand", "upper"}}});
  EXPECT_TRUE(without.proved());
}

// Nothing that is proved is violated at any of many instants; and most of what keeps it is proved.
TEST(CheckTrajectory, WhatIsProvedIsKeptAtEveryInstant) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> angle(-1.2, 1.2), place(-0.5, 0.5);
  const JointedRobot arm = Arm();
  int proved = 0, refused = 0, kept_and_refused = 0;
  for (int i = 0; i < 60; ++i) {
    Trajectory drawn = ArmTrajectory({{0, angle(random), angle(random), angle(random)},
                                      {1, angle(random), angle(random), angle(random)},
                                      {2, angle(random), angle(random), angle(random)}});
    if (i % 2) {
      drawn.interpolation = Interpolation::kCubic;
      drawn.v = 0.5 * drawn.q;
    }
    const Scene scene = WithBall({0.3 + place(random), place(random), 0.3 * place(random)}, 0.2);
    const TrajectoryCheck check = CheckTrajectory(drawn, arm, scene, {.clearance = 0.02});
    const Curves curves(drawn);
    for (const JointedRobot::Body& body : arm.bodies()) {
      if (body.name == "base") continue;
      const bool is_proved = FoundIn(check, Kind::kClearance, body.name + " - ball").proved;
      double least = 1.0;
      for (int n = 0; n <= 400; ++n) {
        const double t = 0.005 * n;
        std::vector<double> q(3);
        for (int j = 0; j < 3; ++j) q[static_cast<size_t>(j)] = curves.Range(j, 0, t, t).Middle();
        least = std::min(least,
                         HintOf(body.shape, arm.urdf().LinkPoses(q)[static_cast<size_t>(body.link)],
                                MakeSphere(0.2), scene.obstacles[0].X_WO)
                             .distance);
      }
      if (is_proved) {
        EXPECT_GT(least, 0.02 - 1e-9);
      }
      ++(is_proved ? proved : refused);
      if (!is_proved && least > 0.0201) ++kept_and_refused;
    }
  }
  EXPECT_GT(proved, 60);
  EXPECT_GT(refused, 10);
  EXPECT_EQ(kept_and_refused, 0);
}

TEST(CheckTrajectory, MistakesAreTold) {
  const Trajectory swing = ArmTrajectory({{0, -1, 0, 0}, {2, 1, 0, 0}});
  EXPECT_THAT(RefusalOf([&] {
                CheckTrajectory(swing, Arm(), {}, {.ignored = {{"hand", "foot"}}});
              }),
              HasSubstr("--ignore: no such link: 'foot'"));
  Scene moving = WithBall({1, 0, 0}, 0.1);
  moving.obstacles[0].motion.speed = 0.1;
  EXPECT_THAT(RefusalOf([&] { CheckTrajectory(swing, Arm(), moving, {}); }),
              HasSubstr("obstacle ball: moves"));
}

}  // namespace
}  // namespace halfstep::checker
