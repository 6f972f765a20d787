// The dynamics of the whole robot: its ZMP against momentum by differences, slopes against
// differences, the drift over intervals against dense samples.

#include "wpg/motion/robot_dynamics.h"

#include <gtest/gtest.h>

#include <optional>

#include "opt/problem/derivative_check.h"
#include "smoothing/walk/posture_tangent.h"
#include "tests/smoothing/drawn_motion.h"
#include "tests/smoothing/robot_truth.h"
#include "tests/wpg/symmetric_masses.h"
#include "wpg/motion/contact_gradient.h"
#include "wpg/motion/leg_drift.h"
#include "wpg/motion/zmp_drift.h"

namespace halfstep {
namespace {

constexpr double kGravity = 9.81;

std::optional<Eigen::Vector2d> ZmpOf(const RobotModel& robot, const WalkJet& jet) {
  const auto posture = MovingPosture(robot, jet);
  if (!posture) return std::nullopt;
  return RobotDynamics(robot, jet, *posture, kGravity).Zmp();
}

TEST(RobotDynamics, ZmpIsThatOfTheMomentumOfAllLinks) {
  constexpr double kStep = 3.5e-3;
  unsigned seed = 700;
  for (const WholeRobot& whole : WholeRobots()) {
    const RobotModel& robot = whole.model;
    ASSERT_TRUE(robot.masses.known()) << robot.masses.fault;
    const PointMasses points(whole);
    WalkDraw draw(seed++);
    int compared = 0;
    double worst = 0, farthest = 0;
    for (int i = 0; i < Draws(100); ++i) {
      const SuperposedWalk walk = DrawnWalkOf(robot, &draw);
      const double t = draw.Uniform(0.05, walk.duration() - 0.05);
      if (NearKnot(walk, t, 5 * kStep)) continue;
      const auto zmp = ZmpOf(robot, walk.At(t));
      if (!zmp) continue;
      ++compared;
      const Eigen::Vector2d truth =
          points.Zmp([&](double dt) { return walk.At(t + dt).value; }, kStep, kGravity);
      worst = std::max(worst, (*zmp - truth).norm());
      farthest = std::max(farthest, (truth - walk.At(t).value.segment<2>(kZmpX)).norm());
    }
    EXPECT_GT(compared, Draws(100) / 3) << robot.name;
    EXPECT_LT(worst, 1e-9) << robot.name;
    EXPECT_GT(farthest, 1e-3) << robot.name << ": the point mass would do";
    RecordProperty(robot.name + "_worst_1e15", static_cast<int>(1e15 * worst));
  }
}

TEST(RobotDynamics, AtRestTheZmpIsBelowTheCentreOfMass) {
  for (const WholeRobot& whole : WholeRobots()) {
    const RobotModel& robot = whole.model;
    WalkJet jet;
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const Leg& leg = robot.legs[static_cast<size_t>(Index(side))];
      const Eigen::Vector3d sole_B = PlaceLeg(leg, leg.standing_q).X_BLink[6].translation();
      jet.value.segment<2>(FootIndex(side)) = sole_B.head<2>() - Eigen::Vector2d(robot.com_x_B, 0);
    }
    const auto zmp = ZmpOf(robot, jet);
    ASSERT_TRUE(zmp) << robot.name;
    EXPECT_NEAR(zmp->x(), 0.0, 1e-9) << robot.name;
  }
}

TEST(RobotDynamics, MirroredAndMovedWalksHaveMirroredAndMovedZmps) {
  const RobotModel robot = Hrp2();
  const RobotModel mirror = WithSymmetricMasses(robot);
  WalkDraw draw(720);
  int compared = 0;
  for (int i = 0; i < Draws(50); ++i) {
    const HalfStepSequence sequence = DrawSequence(robot, 2, {.stride = 0.7}, &draw);
    const HomotopyParameters parameters = draw.Parameters(sequence, 0.0, 0.8);
    const SuperposedWalk walk(sequence, parameters);
    const double t = draw.Uniform(0, walk.duration());
    const Pose2 X_VW = draw.Pose(3, 3);
    const auto zmp = ZmpOf(robot, walk.At(t)), flat = ZmpOf(mirror, walk.At(t));
    const auto moved = ZmpOf(robot, SuperposedWalk(Moved(X_VW, sequence), parameters).At(t));
    const auto mirrored =
        ZmpOf(mirror, SuperposedWalk(Mirrored(sequence), Mirrored(parameters)).At(t));
    if (!zmp || !moved || !mirrored) continue;
    ++compared;
    EXPECT_LT((*moved - X_VW * *zmp).norm(), 1e-11);
    EXPECT_NEAR(mirrored->x(), flat->x(), 1e-10);
    EXPECT_NEAR(mirrored->y(), -flat->y(), 1e-10);
  }
  EXPECT_GT(compared, Draws(50) / 3);
}

TEST(ContactGradient, OfTheZmpAgreesWithDifferences) {
  unsigned seed = 730;
  for (const WholeRobot& whole : WholeRobots()) {
    const RobotModel& robot = whole.model;
    WalkDraw draw(seed++);
    int checked = 0;
    for (int i = 0; i < Draws(60); ++i) {
      const WalkJet jet = [&] {
        const SuperposedWalk walk = DrawnWalkOf(robot, &draw);
        return walk.At(draw.Uniform(0, walk.duration()));
      }();
      const auto posture = MovingPosture(robot, jet);
      if (!posture) continue;
      const RobotDynamics dynamics(robot, jet, *posture, kGravity);
      if (!dynamics.Zmp()) continue;
      ++checked;
      const WalkJet along = DrawnRates(&draw);
      const PostureTangent tangent = Differentiate(robot, jet, *posture, along);
      Eigen::Vector2d slope;
      for (const Eigen::Index axis : {0, 1}) {
        const ContactGradient by(robot, jet, *posture, dynamics,
                                 dynamics.ZmpGradient(Eigen::Vector2d::Unit(axis)));
        slope[axis] = Product(by.jet, along);
        for (const size_t s : {0, 1}) {
          slope[axis] += by.q[s].dot(tangent.q[s]) + by.speeds[s].dot(tangent.speeds[s]);
        }
      }
      const auto function = [&](const Eigen::VectorXd& h) -> Eigen::VectorXd {
        const auto zmp = ZmpOf(robot, Along(jet, h[0], along));
        return zmp ? *zmp : Eigen::Vector2d::Constant(std::nan(""));
      };
      const Eigen::VectorXd here = Eigen::VectorXd::Zero(1);
      const DerivativeReport report = CheckJacobian(function, here, slope, 1e-4);
      EXPECT_TRUE(report.Passed(1e-7)) << robot.name << ": " << report.Describe();
      for (const Eigen::Index broken : {0, 1}) {
        Eigen::MatrixXd wrong = slope;
        wrong(broken, 0) = 1.01 * wrong(broken, 0) + 1e-4;
        EXPECT_FALSE(CheckJacobian(function, here, wrong, 1e-4).Passed(1e-7));
      }
    }
    EXPECT_GT(checked, Draws(60) / 3) << robot.name;
  }
}

// Second derivatives move within a cone of slopes around the middle, across knots as well.
TEST(WalkThirds, HoldAllSlopesOfSecondDerivatives) {
  const RobotModel robot = Hrp2();
  WalkDraw draw(745);
  double excess = -1, nearest = 0;
  for (int i = 0; i < 300; ++i) {  // sanitized, too: fewer do not come near the bounds
    const HalfStepSequence sequence = DrawSequence(robot, 2, {}, &draw);
    const SuperposedWalk walk(sequence, draw.ExtremeParameters(sequence));
    const double length = 1e-4 * std::pow(1000.0, draw.Uniform(0, 1));
    const double begin = draw.Uniform(0.0, walk.duration() - length), middle = begin + length / 2;
    const WalkThirds thirds = walk.ThirdRanges(begin, begin + length);
    const WalkState at_middle = walk.At(middle).second;
    for (const double part : {0.0, draw.Uniform(0, 1), 1.0}) {
      const double dt = (part - 0.5) * length;
      const WalkState change = walk.At(middle + dt).second - at_middle;
      for (int q = 0; q < kNumQuantities; ++q) {
        if (q == kZmpX || q == kZmpY) continue;
        const double off = std::abs(change[q] - dt * thirds.center[q]);
        const double bound = std::abs(dt) * thirds.radius[q];
        excess = std::max(excess, off - bound);
        if (off > 1e-6) nearest = std::max(nearest, off / bound);
      }
    }
  }
  EXPECT_LT(excess, 1e-9);
  EXPECT_GT(nearest, 0.99);
}

// Acceleration of a point that is fixed in a body [m/s²].
Eigen::Vector3d AccelerationOf(const RobotDynamics::Body& body, const Eigen::Vector3d& from_O) {
  const Eigen::Vector3d turn = body.velocity.head<3>();
  return body.acceleration.tail<3>() + body.acceleration.head<3>().cross(from_O) +
         turn.cross(body.velocity.tail<3>() + turn.cross(from_O));
}

TEST(LegDrift, IsNeverExceededInAnyOfItsParts) {
  enum { kPlace, kAcceleration, kTurn, kTurn1, kTurned, kJointSpeed, kJointAcceleration, kParts };
  unsigned seed = 760;
  for (const WholeRobot& whole : WholeRobots()) {
    const RobotModel& robot = whole.model;
    WalkDraw draw(seed++);
    std::array<double, kParts> excess, nearest;
    excess.fill(-1);
    nearest.fill(0);
    VisitIntervals(
        robot, Draws(150), 4, &draw,
        [&](const SuperposedWalk& walk, double begin, double length, const IntervalMotion& motion) {
          if (!motion.bounded) return;
          const RobotDynamics at_m(robot, motion.jet, motion.posture, kGravity);
          const WalkThirds thirds = walk.ThirdRanges(begin, begin + length);
          const WalkJet jet = walk.At(begin + (draw.Uniform(0, 1) < 0.5 ? 0.0 : length));
          Posture posture = SolvePosture(robot, jet.value);
          ASSERT_TRUE(posture.reachable && SolveJointSpeeds(robot, jet, &posture));
          const RobotDynamics there(robot, jet, posture, kGravity);
          for (const Side side : {Side::kLeft, Side::kRight}) {
            const size_t s = static_cast<size_t>(Index(side));
            const LegDrift drift =
                LegDrift::Over(side, motion, DriftOfWaist(robot, motion, thirds),
                               DriftOfSole(motion, thirds, side), at_m,
                               DynamicsRounding::At(robot, motion, at_m, kGravity));
            const auto compare = [&](int part, double truth, double bound) {
              const size_t of = static_cast<size_t>(part);
              excess[of] = std::max(excess[of], truth - bound);
              if (truth > 1e-5) nearest[of] = std::max(nearest[of], truth / bound);
            };
            for (size_t j = 0; j < 6; ++j) {
              const Eigen::Index at = static_cast<Eigen::Index>(j);
              const RobotDynamics::Body &now = at_m.leg(side)[j], &then = there.leg(side)[j];
              const RigidDrift& link = drift.links[j];
              const Eigen::Vector3d point = drift.points[j];
              const Eigen::Isometry3d X =
                  posture.X_WLink[s][j] * motion.posture.X_WLink[s][j].inverse();
              const Eigen::Vector3d moved = X * point;
              compare(kPlace, (moved - point).norm(), link.p);
              compare(
                  kAcceleration,
                  (AccelerationOf(then, moved - there.O()) - AccelerationOf(now, point - at_m.O()))
                      .norm(),
                  link.p2);
              compare(kTurn, (then.velocity - now.velocity).head<3>().norm(), link.turn);
              compare(kTurn1, (then.acceleration - now.acceleration).head<3>().norm(), link.turn1);
              compare(kTurned, Eigen::AngleAxisd(X.linear()).angle(), link.turned);
              compare(kJointSpeed, std::abs(posture.speeds[s][at] - motion.posture.speeds[s][at]),
                      drift.joints[j].speed_drift);
              compare(kJointAcceleration,
                      std::abs(there.accelerations(side)[at] - at_m.accelerations(side)[at]),
                      drift.joints[j].acceleration_drift);
            }
          }
        });
    for (size_t part = 0; part < kParts; ++part) {
      // Accelerations are of the order of 10², known to 1e-12 of that, legs' without closed form
      // less.
      EXPECT_LT(excess[part], 1e-8) << robot.name << ": part " << part;
      EXPECT_GT(nearest[part], 0.5) << robot.name << ": part " << part;
    }
  }
}

TEST(ZmpDrift, IsNeverExceededOnRandomIntervals) {
  unsigned seed = 750;
  for (const WholeRobot& whole : WholeRobots()) {
    const RobotModel& robot = whole.model;
    WalkDraw draw(seed++);
    int intervals = 0, bounded = 0;
    double excess = -1, nearest = 0;
    VisitIntervals(
        robot, Draws(100), 10, &draw,
        [&](const SuperposedWalk& walk, double begin, double length, const IntervalMotion& motion) {
          ++intervals;
          if (!motion.bounded) return;
          const RobotDynamics dynamics(robot, motion.jet, motion.posture, kGravity);
          const auto middle = dynamics.Zmp();
          if (!middle) return;
          const WalkThirds thirds = walk.ThirdRanges(begin, begin + length);
          const RobotDrift of_robot(robot, motion, thirds, dynamics, kGravity);
          const ZmpDrift drift =
              ZmpDrift::Over(robot, motion, thirds, of_robot, dynamics, kGravity);
          if (!(drift.least_push > 0)) return;
          ++bounded;
          const double angle = draw.Uniform(0, 6.3);
          const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
          for (const double part : {0.0, draw.Uniform(0, 1), draw.Uniform(0, 1), 1.0}) {
            const WalkJet jet = walk.At(begin + part * length);
            Posture posture = SolvePosture(robot, jet.value);
            ASSERT_TRUE(posture.reachable && SolveJointSpeeds(robot, jet, &posture));
            const auto there = RobotDynamics(robot, jet, posture, kGravity).Zmp();
            ASSERT_TRUE(there) << robot.name;
            const double moved = std::abs(direction.dot(*there - *middle));
            excess = std::max(excess, moved - drift.Along(direction));
            if (moved > 1e-6) nearest = std::max(nearest, moved / drift.Along(direction));
          }
        });
    EXPECT_GT(bounded, intervals / 2) << robot.name;
    EXPECT_LT(excess, 1e-9) << robot.name;
    // By norms where the legs' inertia is concerned; a term forgotten shows in LegDrift's parts.
    EXPECT_GT(nearest, 0.7) << robot.name;
    RecordProperty(robot.name + "_bounded_percent", 100 * bounded / intervals);
  }
}

}  // namespace
}  // namespace halfstep
