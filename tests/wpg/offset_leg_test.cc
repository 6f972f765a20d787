#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/wpg/hrp2.h"
#include "tests/wpg/leg_differences.h"
#include "tests/wpg/offset_leg_fixture.h"
#include "wpg/robot/leg_continuation.h"
#include "wpg/robot/offset_leg_bound.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using testing::HasSubstr;

TEST_P(OffsetLegTest, BringsTheSoleWhereItIsAskedToBe) {
  for (const Leg& leg : robot_.legs) {
    ASSERT_FALSE(leg.closed_form());
    int solved = 0;
    for (int k = 0; k < 500; ++k) {
      const Isometry3d X_BSole = LevelSole(DrawSole(leg));
      const LegIkSolution solution = SolveLegIk(leg, X_BSole);
      EXPECT_EQ(solution.reach_margin < 0, solution.status == LegIkStatus::kOutOfReach);
      if (solution.status != LegIkStatus::kSolved) continue;
      ++solved;
      EXPECT_LT(PoseDifference(LegForwardKinematics(leg, solution.q)[6], X_BSole), 1e-13);
    }
    EXPECT_GT(solved, 450);
  }
}

TEST_P(OffsetLegTest, StandsInTheStandingPosture) {
  for (const Leg& leg : robot_.legs) {
    const LegIkSolution solution = SolveLegIk(leg, LegForwardKinematics(leg, leg.standing_q)[6]);
    ASSERT_EQ(solution.status, LegIkStatus::kSolved);
    EXPECT_LT((solution.q - leg.standing_q).norm(), 1e-12);
  }
}

// A function of the pose that is continuous, and so one branch, along any way of the sole.
TEST_P(OffsetLegTest, BranchIsContinuousAlongWays) {
  for (const Leg& leg : robot_.legs) {
    int steps = 0;
    for (int way = 0; way < 10; ++way) {
      const Eigen::Vector4d from = DrawSole(leg), to = DrawSole(leg);
      LegIkSolution last = SolveLegIk(leg, LevelSole(from));
      for (int k = 1; k <= 200; ++k) {
        const LegIkSolution here = SolveLegIk(leg, LevelSole(from + (to - from) * (k / 200.0)));
        if (last.status == LegIkStatus::kSolved && here.status == LegIkStatus::kSolved) {
          ++steps;
          EXPECT_LT((here.q - last.q).cwiseAbs().maxCoeff(), 0.1);
        }
        last = here;
      }
    }
    EXPECT_GT(steps, 1500);
  }
}

// The largest error of the derivative, relative to what it should be.
double DerivativeError(const Leg& leg, const Eigen::Matrix<double, 8, 1>& p, double wrong) {
  const double h = 1e-6;
  const auto solve = [&](const Eigen::Matrix<double, 8, 1>& at) {
    return SolveLegIk(leg, LevelSole(at.head<4>()).inverse() * LevelSole(at.tail<4>()));
  };
  Eigen::Matrix<double, 6, 8> dq;
  EXPECT_TRUE(
      LegIkDerivative(leg, solve(p).q, LevelSole(p.head<4>()), LevelSole(p.tail<4>()), &dq));
  dq(3, 6) *= wrong;  // the knee, by the height of the sole
  double worst = 0;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Matrix<double, 8, 1> step = h * Eigen::Matrix<double, 8, 1>::Unit(i);
    const Vector6d slope = (solve(p + step).q - solve(p - step).q) / (2 * h);
    for (int j = 0; j < 6; ++j) {
      worst = std::max(worst, std::abs(dq(j, i) - slope[j]) / (1 + std::abs(slope[j])));
    }
  }
  return worst;
}

TEST_P(OffsetLegTest, DerivativeAgreesWithCentralDifferences) {
  const Leg& leg = robot_.legs[0];
  std::uniform_real_distribution<> unit(-1, 1);
  int tried = 0;
  for (int k = 0; k < 100; ++k) {
    const Eigen::Vector4d sole = DrawSole(leg);
    const LegIkSolution solution = SolveLegIk(leg, LevelSole(sole));
    if (solution.status != LegIkStatus::kSolved || solution.reach_margin < 0.01) continue;
    ++tried;
    Eigen::Matrix<double, 8, 1> p;  // waist x y z yaw, sole x y z yaw
    p << unit(random_), unit(random_), unit(random_), 3 * unit(random_), 0, 0, 0, 0;
    p.segment<3>(4) = LevelSole(p.head<4>()) * sole.head<3>();
    p[7] = p[3] + sole[3];
    EXPECT_LT(DerivativeError(leg, p, 1.0), 1e-5);
    EXPECT_GT(DerivativeError(leg, p, 1.001), 5e-5) << "a broken one must show";
  }
  EXPECT_GT(tried, 50);
}

// The distance from hip to ankle, which the knee alone changes.
TEST_P(OffsetLegTest, ReachMarginIsOfThePointsOnThighAndShank) {
  for (const Leg& leg : robot_.legs) {
    for (int k = 0; k < 50; ++k) {
      const LegIkSolution solution = SolveLegIk(leg, LevelSole(DrawSole(leg)));
      if (solution.status != LegIkStatus::kSolved) continue;
      const LegFrames frames = PlaceLeg(leg, solution.q);
      const Vector3d hip = frames.X_BLink[2] * (leg.joints[2].X_BLink.inverse() * leg.hip_B);
      const Vector3d ankle = frames.X_BLink[3] * (leg.joints[3].X_BLink.inverse() * leg.ankle_B);
      const LegLength length = LegLengthAt(leg, solution.q[3]);
      EXPECT_NEAR(length.distance, (ankle - hip).norm(), 1e-12);
      const double longest = length.distance + solution.reach_margin;
      for (int j = -4; j <= 4; ++j) {
        EXPECT_LE(LegLengthAt(leg, solution.q[3] + 0.3 * j).distance, longest + 1e-12);
      }
      const double h = 1e-6;
      const double slope = (LegLengthAt(leg, solution.q[3] + h).distance -
                            LegLengthAt(leg, solution.q[3] - h).distance) /
                           (2 * h);
      EXPECT_NEAR(length.slope, slope, 1e-8);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, OffsetLegTest, testing::Range(0, 3), [](const auto& robot) {
  return OffsetRobots()[static_cast<size_t>(robot.param)].name;
});

// Levers of 30 cm, from the stretched leg on: the length's slope is zero there.
TEST(OffsetLeg, LengthChangesNoMoreThanItsBound) {
  for (const double turn : {0.01, 0.1, 0.5}) {
    const double shorter = 0.6 - 0.6 * std::cos(0.5 * turn);
    EXPECT_LE(shorter, LegLengthChange({.distance = 0.6, .slope = 0.0, .product = 0.09}, turn));
  }
}

// Continued from itself, a leg with closed form gives the closed form.
TEST(OffsetLeg, WithoutOffsetIsTheClosedForm) {
  std::vector<Leg> legs = {LoadRobot(kHrp2).legs[0]};
  for (const GeneratedRobot& robot : GeneratedRobots()) legs.push_back(MakeLeg(robot, Side::kLeft));
  std::mt19937 random(5);
  std::uniform_real_distribution<> unit(-1, 1);
  for (const Leg& leg : legs) {
    Leg continued = leg;
    continued.met = {leg};
    const Vector3d standing = LegForwardKinematics(leg, leg.standing_q)[6].translation();
    for (int k = 0; k < 300; ++k) {
      Eigen::Vector4d sole;
      sole << standing, 0.4 * unit(random);
      sole.head<3>() += 0.2 * Vector3d(unit(random), 0.5 * unit(random), 1 + unit(random));
      const LegIkSolution closed = SolveLegIk(leg, LevelSole(sole));
      const LegIkSolution other = SolveLegIk(continued, LevelSole(sole));
      EXPECT_EQ(closed.status == LegIkStatus::kSolved, other.status == LegIkStatus::kSolved);
      if (closed.status != LegIkStatus::kSolved) continue;
      EXPECT_LT(AngleDifference(closed.q, other.q), 1e-12);
      EXPECT_NEAR(closed.reach_margin, other.reach_margin, 1e-12);
    }
  }
}

// The smaller the offsets, the nearer to the closed form.
TEST(OffsetLeg, GoesToTheClosedFormWithItsOffsets) {
  GeneratedRobot robot = OffsetRobots()[2];
  const auto offset = robot.offset;
  const auto knee = [&](double share) {
    for (size_t i = 0; i < 6; ++i) robot.offset[i] = share * offset[i];
    const Leg leg = TemporaryRobot(robot).Load().legs[0];
    EXPECT_EQ(leg.closed_form(), share == 0);
    Isometry3d X_BSole = LegForwardKinematics(MakeLeg(robot, Side::kLeft), leg.standing_q)[6];
    X_BSole.translation() += Vector3d(0.1, 0.05, 0.04);
    return SolveLegIk(leg, X_BSole).q[3];
  };
  const double closed = knee(0);
  EXPECT_NEAR(knee(1e-3), closed, 1e-3);
  EXPECT_GT(std::abs(knee(1e-3) - closed), 1e-6);
  EXPECT_NEAR(knee(1e-4), closed, 1e-4);
}

TEST(OffsetLeg, IsToldWithAxesAndDistances) {
  const RobotModel robot = TemporaryRobot(OffsetRobots()[0]).Load();
  std::string told;
  for (const std::string& warning : robot.warnings) told += warning + "\n";
  for (const std::string side : {"left", "right"}) {
    EXPECT_THAT(told, HasSubstr(side + "_joint0: hip axes " + side + "_joint0 and " + side +
                                "_joint2 pass each other at 50.0 mm, hip axes " + side +
                                "_joint1 and " + side +
                                "_joint2 pass each other at 66.0 mm: the "
                                "closed form does not apply; joint angles are those of a leg whose "
                                "axes meet, continued with proof to this one, which takes longer"));
  }
}

// Two links with two joints between them are joined only where the axes meet.
TEST(OffsetLeg, WatchesLinksWhoseAxesDoNotMeet) {
  const auto joined = [](size_t which, const std::string& at) {
    int count = 0;
    for (const UnwatchedPair& pair : TemporaryRobot(OffsetRobots()[which]).Load().unwatched_pairs) {
      count += pair.why.starts_with("joined at the " + at);
    }
    return count;
  };
  EXPECT_EQ(joined(1, "ankle"), 0) << "40 mm apart";
  EXPECT_GT(joined(0, "ankle"), 0);
}

}  // namespace
}  // namespace halfstep
