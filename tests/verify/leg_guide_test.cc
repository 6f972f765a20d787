// Angles of legs without closed form, found from near ones and alone.

#include "experiments/verify/leg_guide.h"

#include <gtest/gtest.h>

#include <random>

#include "experiments/verify/described_walk.h"
#include "experiments/verify/recent_instants.h"
#include "tests/verify/rows_of.h"

namespace halfstep::verify {
namespace {

// HRP-2 with hip and ankle axes that miss each other.
RobotModel WithOffsetLegs(RobotModel robot) {
  for (Leg& leg : robot.legs) {
    leg.met = {leg};
    leg.joints[0].point_B.x() += 0.02;
    leg.joints[5].point_B.z() -= 0.01;
  }
  return robot;
}

// Borrows the robot.
DescribedWalk DescribedBy(const RobotModel& robot) {
  const SuperposedWalk walk(Fig5().sequence, PlannedMotion(Fig5().sequence));
  return DescribedWalk(robot, PlanOf(Fig5().sequence), RowsOf(walk));
}

void ExpectAnglesFoundAlone(const DescribedWalk& walk, double from) {
  const RobotModel& robot = walk.robot();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> times(from, walk.end());
  for (int k = 0; k < 100; ++k) {
    const double t = times(random);
    const auto near = walk.NearAngles(t);
    const RobotPosture alone = PostureOf(robot, walk.At(t).value);
    const PlayedRow row = walk.Row(t);
    for (size_t side = 0; side < 2; ++side) {
      EXPECT_LT((near[side] - alone.q[side]).cwiseAbs().maxCoeff(), 5e-3) << t;
      EXPECT_LT((row.q[side] - alone.q[side]).cwiseAbs().maxCoeff(), 1e-12) << t;
    }
  }
}

TEST(LegGuide, LeadsToTheAnglesThatAreFoundAlone) {
  const RobotModel robot = WithOffsetLegs(Fig5().robot);
  const DescribedWalk walk = DescribedBy(robot);
  ExpectAnglesFoundAlone(walk, 0.0);
  const int last = walk.num_half_steps() - 2;
  const DescribedWalk branch = walk.StopBranch(last);
  ExpectAnglesFoundAlone(branch, walk.WindowOf(last).first);
}

TEST(LegGuide, IsEmptyWhereThereIsAClosedForm) {
  const DescribedWalk walk = DescribedBy(Fig5().robot);
  EXPECT_TRUE(walk.NearAngles(1.0)[0].array().isNaN().all());
}

// A leg that does not reach, for all of the walk or the part before the robot sinks, has no angles.
TEST(LegGuide, KnowsNothingWhereALegDoesNotReach) {
  RobotModel robot = WithOffsetLegs(Fig5().robot);
  robot.waist_height += 0.5;
  const DescribedWalk walk = DescribedBy(robot);
  EXPECT_TRUE(walk.NearAngles(1.0)[1].array().isNaN().all());
  EXPECT_TRUE(walk.Row(1.0).q[1].array().isNaN().all());
}

// Near angles are a start only: of others than those of the motion nothing is taken.
TEST(AnglesOf, TakesNothingOfAnglesThatAreNotNear) {
  const RobotModel robot = WithOffsetLegs(Fig5().robot);
  const DescribedWalk walk = DescribedBy(robot);
  const WalkNumbers x = walk.At(1.1).value;
  const RobotPosture alone = PostureOf(robot, x);
  std::mt19937 random(6);
  for (const double off : {1e-3, 0.04, 0.2, 1.0, 100.0}) {
    std::uniform_real_distribution<double> draw(-off, off);
    for (int k = 0; k < 20; ++k) {
      std::array<Vector6d, 2> near = alone.q;
      for (Vector6d& q : near) {
        for (double& angle : q) angle += draw(random);
      }
      const RobotPosture found = PostureOf(robot, x, &near);
      ASSERT_TRUE(found.reached);
      for (size_t side = 0; side < 2; ++side) {
        EXPECT_LT((found.q[side] - alone.q[side]).cwiseAbs().maxCoeff(), 1e-12) << off;
      }
    }
  }
}

TEST(RecentInstants, SayWhatTheWalkSays) {
  const RobotModel robot = WithOffsetLegs(Fig5().robot);
  const DescribedWalk walk = DescribedBy(robot);
  RecentInstants recent(walk);
  for (int k = 0; k < 40; ++k) {
    const double t = 0.1 * (k % 11);  // more than are remembered
    EXPECT_EQ(recent.Row(t).q, walk.Row(t).q);
    EXPECT_EQ(recent.Dynamics(t).zmp, walk.DynamicsAt(t).zmp);
    EXPECT_EQ(recent.JointSpeeds(t), walk.JointSpeeds(t));
  }
}

}  // namespace
}  // namespace halfstep::verify
