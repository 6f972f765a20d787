#include "smoothing/margins/margin_evaluator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "planner/collision/separation.h"
#include "smoothing/margins/family_class.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/smoothing/test_scenes.h"
#include "tests/smoothing/test_walks.h"
#include "tests/wpg/joint_limits.h"
#include "tests/wpg/symmetric_masses.h"
#include "wpg/motion/lipm.h"
#include "wpg/robot/torque_limits.h"

namespace halfstep {
namespace {

// One step of the right foot, 0.2 m ahead.
HalfStepSequence RightStep(const RobotModel& robot) {
  return MakeSequence(StandingFeet(),
                      {{.side = Side::kRight, .X_WF = Foothold::Level({0.2, -0.105, 0.1})}}, 0.24,
                      {}, std::make_shared<Lipm>(robot.com_height));
}

// With every family that a config has to ask for.
MarginLimits AllAsked() {
  MarginLimits limits;
  limits.demanded_of(MarginFamily::kDoubleSupport) = 0.05;
  limits.landing_speed = 0.3;
  return limits;
}

class MarginEvaluatorTest : public testing::Test {
 protected:
  MarginSet At(const SuperposedWalk& walk, const LocalTime& at, const Scene& scene = {},
               const MarginLimits& limits = AllAsked()) const {
    const MarginEvaluator evaluator(robot_, scene, limits);
    MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
    return evaluator.At(walk, at, &scratch);
  }

  const RobotModel robot_ =
      WithAccelerationLimits(WithTorqueLimits(WithSymmetricMasses(Hrp2()), 300.0), 300.0);
  const HalfStepSequence sequence_ = RightStep(robot_);
  const SuperposedWalk walk_{sequence_, PlannedMotion(sequence_)};
};

// Soles 0.2172 × 0.137 m, 0.105 m to either side: both together reach 0.1735 m to the side.
TEST_F(MarginEvaluatorTest, ZmpMarginByHand) {
  const auto zmp = [&](double tau) { return Of(At(walk_, {0, tau}), MarginFamily::kZmp); };
  EXPECT_NEAR(zmp(0.0).value, 0.1086, 1e-12);  // mid-feet: the front and the back are nearest
  EXPECT_EQ(zmp(0.0).subject, -1);
  EXPECT_NEAR(zmp(1.0).value, 0.1086, 1e-12);  // half-way of the shift, y = 0.0525
  EXPECT_NEAR(zmp(2.0).value, 0.0685, 1e-12);  // at the centre of the support sole
  EXPECT_EQ(zmp(2.0).subject, 0);
  // At the peak of the bump after the shift it is beyond the centre, by that part of 0.105 m.
  const HalfStepTracks& tracks = walk_.tracks(0);
  const double peak = 2.0 - 0.5 * tracks.t1();
  const double beyond = 0.105 * (tracks.of(kZmpY).At(peak).value - 1.0);
  EXPECT_NEAR(zmp(peak).value, 0.0685 - beyond, 1e-12);
  EXPECT_GT(beyond, 0.005);
  // From lift-off on the support sole alone counts: a jump, also at the instant itself.
  EXPECT_NEAR(zmp(tracks.t2()).value, 0.0685, 1e-9);
  EXPECT_GT(zmp(tracks.t2() - 1e-9).value, 0.068);
  EXPECT_EQ(zmp(tracks.t2() - 1e-9).subject, -1);
}

TEST_F(MarginEvaluatorTest, FloorMarginIsTheHeightOfTheSoleWhileItMovesHorizontally) {
  // At 0.9 the way down begins before the way up moves horizontally by itself.
  for (double fraction : {0.6, 0.9}) {
    const SuperposedWalk walk(sequence_, Overlapped(sequence_, fraction));
    int moving = 0;
    for (int n = 0; n <= 400; ++n) {
      const double t = walk.duration() * n / 400;
      const Margin floor = Of(At(walk, walk.Locate(t)), MarginFamily::kFloor);
      const WalkJet jet = walk.At(t);
      if (jet.first.segment<2>(kRightX).norm() > 0.0) {
        EXPECT_EQ(floor.value, jet.value[kRightZ]) << t;
        EXPECT_EQ(floor.subject, Index(Side::kRight));
        ++moving;
      } else {
        EXPECT_EQ(floor.value, kUnlimited) << t;
      }
    }
    EXPECT_GT(moving, 50);
  }
}

TEST_F(MarginEvaluatorTest, FootSpeedsAreThoseOfTheSwingSole) {
  const MarginLimits limits{.foot_speed = 0.9, .foot_yaw_rate = 1.5};
  MarginLimits none;
  none.foot_speed.reset(), none.foot_yaw_rate.reset();
  const SuperposedWalk walk(sequence_, Overlapped(sequence_, 0.5));
  for (int n = 1; n < 100; ++n) {
    const double t = walk.duration() * n / 100, h = 1e-5;
    const LocalTime at = walk.Locate(t);
    const MarginSet margins = At(walk, at, {}, limits);
    if (!walk.InAir(at, Side::kRight)) {
      EXPECT_EQ(Of(margins, MarginFamily::kFootSpeed).value, kUnlimited);
      continue;
    }
    const Eigen::Vector4d rate =
        (walk.At(t + h).value - walk.At(t - h).value).segment<4>(kRightX) / (2 * h);
    EXPECT_NEAR(Of(margins, MarginFamily::kFootSpeed).value, 0.9 - rate.head<3>().norm(), 1e-6);
    EXPECT_NEAR(Of(margins, MarginFamily::kFootYawRate).value, 1.5 - std::abs(rate[3]), 1e-6);
    EXPECT_EQ(Of(At(walk, at, {}, none), MarginFamily::kFootSpeed).value, kUnlimited);
    EXPECT_EQ(Of(At(walk, at, {}, none), MarginFamily::kFootYawRate).value, kUnlimited);
  }
}

TEST_F(MarginEvaluatorTest, JointMarginsAreTheLeastOverAllTwelveJoints) {
  const MarginLimits limits{.joint_speed_scale = 0.5};
  for (int n = 0; n <= 50; ++n) {
    const double t = walk_.duration() * n / 50;
    Posture posture = SolvePosture(robot_, walk_.At(t).value);
    ASSERT_TRUE(posture.reachable);
    ASSERT_TRUE(SolveJointSpeeds(robot_, walk_.At(t), &posture));
    double joint = kUnlimited, speed = kUnlimited;
    for (size_t s = 0; s < 2; ++s) {
      for (int j = 0; j < 6; ++j) {
        const LegJoint& limit = robot_.legs[s].joints[static_cast<size_t>(j)];
        const double q = posture.ik[s].q[j];
        joint = std::min({joint, q - limit.lower, limit.upper - q});
        speed = std::min(speed, 0.5 * limit.max_speed - std::abs(posture.speeds[s][j]));
      }
    }
    const MarginSet margins = At(walk_, walk_.Locate(t), {}, limits);
    EXPECT_EQ(Of(margins, MarginFamily::kJoint).value, joint);
    EXPECT_EQ(Of(margins, MarginFamily::kJointSpeed).value, speed);
    EXPECT_EQ(Of(margins, MarginFamily::kReach).value,
              std::min(posture.ik[0].reach_margin, posture.ik[1].reach_margin));
  }
}

TEST_F(MarginEvaluatorTest, OutOfReachEveryMarginOfTheBodyIsLost) {
  const HalfStepSequence far = MakeSequence(
      StandingFeet(), {{.side = Side::kRight, .X_WF = Foothold::Level({0.9, -0.105, 0})}}, 0.24, {},
      std::make_shared<Lipm>(robot_.com_height));
  const SuperposedWalk walk(far, PlannedMotion(far));
  const MarginSet margins = At(walk, {1, 2.0});
  EXPECT_LT(Of(margins, MarginFamily::kReach).value, 0.0);
  for (MarginFamily family : {MarginFamily::kJoint, MarginFamily::kJointSpeed,
                              MarginFamily::kClearance, MarginFamily::kSelfClearance}) {
    EXPECT_EQ(Of(margins, family).value, -kUnlimited) << Name(family);
  }
  const MarginEvaluator evaluator(robot_, {}, {});
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  const auto violation = evaluator.FirstViolation(walk, {1, 2.0}, &scratch);
  ASSERT_TRUE(violation);
  EXPECT_EQ(violation->family, MarginFamily::kReach);
}

// Before a wall as large as the room: its distance is that of the foremost point of the robot.
TEST_F(MarginEvaluatorTest, ClearanceFromAWallByHand) {
  Scene scene;
  scene.obstacles.push_back(
      {"wall", MakeBox({0.2, 6, 6}), Eigen::Isometry3d(Eigen::Translation3d(0.6, 0, 0))});
  for (int n = 0; n <= 40; ++n) {
    const double t = walk_.duration() * n / 40;
    Posture posture = SolvePosture(robot_, walk_.At(t).value);
    double foremost = -kUnlimited;
    for (const RobotBody& body : robot_.bodies) {
      const Eigen::Isometry3d& X = posture.OfBody(body);
      foremost = std::max(foremost,
                          X.translation().x() + Support(body.shape, X.linear().transpose().col(0)));
    }
    const Margin clearance = Of(At(walk_, walk_.Locate(t), scene), MarginFamily::kClearance);
    EXPECT_NEAR(clearance.value, std::min(0.3, 0.5 - foremost), 1e-9);
    if (clearance.value < 0.3) {
      EXPECT_EQ(clearance.other, 0);
      EXPECT_GE(clearance.subject, 0);
    }
  }
}

TEST_F(MarginEvaluatorTest, SelfClearanceIsTheLeastOfAllPairs) {
  WalkDraw draw(60);
  int checked = 0;
  for (int i = 0; i < Draws(150); ++i) {
    const HalfStepSequence sequence = draw.Sequence(2);
    const SuperposedWalk walk(sequence, draw.ExtremeParameters(sequence));
    const LocalTime at = walk.Locate(draw.Uniform(0, walk.duration()));
    Posture posture = SolvePosture(robot_, walk.At(at).value);
    if (!posture.reachable) continue;
    double least = 0.3;
    for (const auto& [a, b] : robot_.self_pairs) {
      const RobotBody& body_a = robot_.bodies[static_cast<size_t>(a)];
      const RobotBody& body_b = robot_.bodies[static_cast<size_t>(b)];
      least = std::min(least, Separate(CollisionShape(body_a.shape), posture.OfBody(body_a),
                                       CollisionShape(body_b.shape), posture.OfBody(body_b))
                                  .distance);
    }
    const Margin margin = Of(At(walk, at), MarginFamily::kSelfClearance);
    ++checked;
    EXPECT_NEAR(margin.value, least, least > 0 ? 1e-9 : 1e-6);
  }
  EXPECT_GT(checked, Draws(50));
}

TEST_F(MarginEvaluatorTest, AnotherObstacleNeverRaisesAMarginAndTouchesClearanceOnly) {
  WalkDraw draw(61);
  int lowered = 0;
  for (int i = 0; i < Draws(100); ++i) {
    const SuperposedWalk walk(sequence_, Overlapped(sequence_, draw.Uniform(0, 1)));
    const LocalTime at = walk.Locate(draw.Uniform(0, walk.duration()));
    Scene scene;
    scene.obstacles.push_back(RandomObstacle(&draw));
    const MarginSet before = At(walk, at, scene);
    scene.obstacles.push_back(RandomObstacle(&draw));
    const MarginSet after = At(walk, at, scene);
    for (MarginFamily family : AllMarginFamilies()) {
      if (family == MarginFamily::kClearance) continue;
      EXPECT_EQ(Of(before, family).value, Of(after, family).value);
    }
    const double a = Of(before, MarginFamily::kClearance).value;
    const double b = Of(after, MarginFamily::kClearance).value;
    EXPECT_LE(b, a);
    if (b < a) ++lowered;
  }
  EXPECT_GT(lowered, Draws(100) / 10);
}

TEST_F(MarginEvaluatorTest, MarginsDoNotDependOnWhereAndOnWhichSide) {
  WalkDraw draw(62);
  int compared = 0;
  for (int i = 0; i < Draws(100); ++i) {
    const HalfStepSequence sequence = draw.Sequence(2);
    const HomotopyParameters parameters = draw.ExtremeParameters(sequence);
    const SuperposedWalk walk(sequence, parameters);
    const double t = draw.Uniform(0, walk.duration());
    if (NearKnot(walk, t, 1e-9)) continue;
    const WalkState x = walk.At(t).value;
    Scene scene;
    scene.obstacles.push_back(RandomObstacle(&draw));
    scene = Moved({x[kComX], x[kComY], x[kWaistYaw]}, scene);
    const Pose2 X_VW = draw.Pose(2, 3);
    const MarginSet plain = At(walk, walk.Locate(t), scene);
    const SuperposedWalk mirrored(Mirrored(sequence), Mirrored(parameters));
    const SuperposedWalk moved(Moved(X_VW, sequence), parameters);
    const MarginSet m = At(mirrored, mirrored.Locate(t), Mirrored(scene));
    const MarginSet v = At(moved, moved.Locate(t), Moved(X_VW, scene));
    for (MarginFamily family : AllMarginFamilies()) {
      const double value = Of(plain, family).value;
      if (!std::isfinite(value)) {
        EXPECT_EQ(Of(m, family).value, value);
        EXPECT_EQ(Of(v, family).value, value);
        continue;
      }
      ++compared;
      // Deep overlaps have no exact depth: it is found by local search.
      const bool overlap = Name(family).find("clearance") != std::string::npos && value < 0;
      const double tolerance = overlap ? 1e-2 : 1e-9 * (1 + std::abs(value));
      EXPECT_NEAR(Of(m, family).value, value, tolerance) << Name(family);
      EXPECT_NEAR(Of(v, family).value, value, tolerance) << Name(family);
    }
  }
  EXPECT_GT(compared, Draws(100) * 4);
}

TEST_F(MarginEvaluatorTest, OfARobotWithoutMassesNothingIsSaidOfItsDynamics) {
  RobotModel robot = robot_;
  robot.masses.fault = "the left leg has no mass";
  EXPECT_EQ(TorqueFault(robot), robot.masses.fault);
  const MarginEvaluator evaluator(robot, {}, {});
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  const MarginSet margins = evaluator.At(walk_, {0, 1.0}, &scratch);
  constexpr std::array kOfDynamics = {MarginFamily::kZmpRobot, MarginFamily::kTorque,
                                      MarginFamily::kFriction};
  for (const MarginFamily family : kOfDynamics) {
    EXPECT_EQ(evaluator.limits().demanded_of(family), kNotDemanded);
    EXPECT_EQ(evaluator.WithLimits({}).limits().demanded_of(family), kNotDemanded);
    EXPECT_EQ(Of(margins, family).value, -kUnlimited);
  }
  EXPECT_FALSE(evaluator.FirstViolation(walk_, {0, 1.0}, &scratch));
  Certificate certificate;
  const CertifiedFeasibility test(evaluator, {});
  ASSERT_EQ(test.Certify(walk_, &scratch, &certificate).verdict, Verdict::kFeasible);
  for (const CertificateRow& row : certificate) {
    if (std::ranges::find(kOfDynamics, row.family) == kOfDynamics.end()) continue;
    EXPECT_EQ(row.margin.value, kUnlimited);
  }
}

TEST_F(MarginEvaluatorTest, TorqueLimitsThatAreNotKnownDemandNothing) {
  MarginLimits limits;
  limits.demanded_of(MarginFamily::kTorque) = 10.0;
  RobotModel robot = Hrp2();
  EXPECT_EQ(JointsOfUnknownTorque(robot).size(), 12u);
  const MarginEvaluator nothing(robot, {}, limits);
  EXPECT_EQ(nothing.limits().demanded_of(MarginFamily::kTorque), kNotDemanded);
  MarginEvaluator::Scratch scratch = nothing.MakeScratch();
  EXPECT_EQ(Of(nothing.At(walk_, {0, 1.0}, &scratch), MarginFamily::kTorque).value, kUnlimited);
  // One joint's limit is known: the support knee's.
  robot.legs[0].joints[3].max_torque = 40.0;
  EXPECT_EQ(TorqueFault(robot), "");
  const MarginEvaluator evaluator(robot, {}, limits);
  const Margin torque = Of(evaluator.At(walk_, {0, 2.0}, &scratch), MarginFamily::kTorque);
  EXPECT_EQ(evaluator.statements(MarginFamily::kTorque).Subject(torque), "LLEG_JOINT3");
  EXPECT_LT(torque.value, 0.0);
  const auto violated = evaluator.FirstViolation(walk_, {0, 2.0}, &scratch);
  ASSERT_TRUE(violated);
  EXPECT_EQ(violated->family, MarginFamily::kTorque);
}

// A robot of one mass stands still on both feet: half of its weight on each, no friction is needed.
TEST_F(MarginEvaluatorTest, AtRestNoFrictionIsNeeded) {
  Scene scene;
  scene.friction = 0.4;
  EXPECT_NEAR(Of(At(walk_, {0, 0.0}, scene), MarginFamily::kFriction).value, 0.4, 1e-12);
  EXPECT_LT(Of(At(walk_, {0, 2.2}, scene), MarginFamily::kFriction).value, 0.4);
}

TEST_F(MarginEvaluatorTest, DescribesAMarginWithItsOwnerPlaceAndDemand) {
  Scene scene;
  scene.obstacles.push_back(
      {"bar", MakeSphere(0.05), Eigen::Isometry3d(Eigen::Translation3d(0.1, -0.135, 0.3))});
  const MarginEvaluator evaluator(robot_, scene, {});
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  const auto violation = evaluator.FirstViolation(walk_, {0, 2.0}, &scratch);
  ASSERT_TRUE(violation);
  const std::string text = evaluator.Describe(*violation);
  for (const char* part :
       {"clearance of ", "RLEG_LINK", " - bar", "demanded 0.005", "half-step 1, tau = 2 s"}) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  }
  EXPECT_EQ(evaluator.Subject({.family = MarginFamily::kJoint, .subject = 6}), "RLEG_JOINT0");
  EXPECT_EQ(evaluator.Subject({.family = MarginFamily::kFootSpeed, .subject = 1}), "right foot");
  EXPECT_EQ(evaluator.Subject({.family = MarginFamily::kReach, .subject = 3}), "left leg");
}

TEST(MarginFamilies, AreThoseOfTheirClassesInOrder) {
  const MarginEvaluator evaluator(Hrp2(), {}, {});
  for (MarginFamily family : AllMarginFamilies()) {
    EXPECT_EQ(Traits(family).family, family);
    EXPECT_EQ(ClassOf(family).make(evaluator.place())->family(), family);
  }
  EXPECT_EQ(Name(MarginFamily::kClearance), "clearance");
  EXPECT_EQ(Unit(MarginFamily::kJointSpeed), "rad/s");
}

}  // namespace
}  // namespace halfstep
