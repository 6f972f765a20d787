// Terms of the bounds of motions, each where nothing else hides it.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/smoothing/motion_truth.h"
#include "tests/wpg/hrp2.h"
#include "wpg/motion/motion_bounds.h"

namespace halfstep {
namespace {

// HRP-2 with its CoM above the waist's origin, its ankles above the soles' centres, and for a body
// a dot on a link of the left leg.
RobotModel WithDot(int link, const Eigen::Vector3d& place_Link) {
  RobotModel robot = Hrp2();
  robot.com_x_B = 0.0;
  for (Leg& leg : robot.legs) leg.X_BSole.translation().head<2>() = leg.ankle_B.head<2>();
  RobotBody dot{.name = "dot", .leg = 0, .link = link, .shape = MakeSphere(1e-6)};
  dot.shape.vertices.col(0) = place_Link;
  BoundBySphere(&dot.shape);
  robot.bodies = {dot};
  robot.self_pairs.clear();
  return robot;
}

// The waist's origin in W's, the hips above the ankles, everything at rest.
WalkJet Upright(const RobotModel& robot) {
  WalkJet jet;
  for (Side side : {Side::kLeft, Side::kRight}) {
    jet.value.segment<2>(FootIndex(side)) =
        robot.legs[static_cast<size_t>(Index(side))].hip_B.head<2>();
  }
  return jet;
}

Eigen::Vector2d Across(const Eigen::Vector2d& x) { return {-x.y(), x.x()}; }  // ẑ × x

// Largest truth / bound of one thing at the end of a motion without second derivatives.
double ShareAtTheEnd(const RobotModel& robot, const WalkJet& mid, double h, Bounded what,
                     int which) {
  const std::vector<Eigen::Matrix3Xd> points = OuterPoints(robot);
  IntervalMotion motion;
  MotionBounds(robot).Bound(mid, WalkState::Zero(), h, &motion);
  EXPECT_TRUE(motion.bounded);
  double share = 0.0;
  for (const double t : {-h, h}) {
    WalkJet jet = mid;
    jet.value += t * mid.first;
    CompareWithTruth(robot, points, jet, motion,
                     [&](Bounded kind, int index, double truth, double bound) {
                       EXPECT_LE(truth, bound + 1e-12) << kBoundedNames[static_cast<size_t>(kind)];
                       if (kind == what && index == which) share = std::max(share, truth / bound);
                     });
  }
  return share;
}

// The terms of turning frames, each where nothing else hides it. A dot out on the thigh, which
// turns with the waist and once more about the hip, is at rest for an instant.
TEST(MotionBounds, NeedTheCoriolisTermOfALinkOnATurningWaist) {
  const double turn = 1.0, more = 2.0;
  const Eigen::Vector3d outwards(0, 0.5, 0);
  RobotModel robot = WithDot(2, {0, 0, 0});
  WalkJet mid = Upright(robot);
  const Leg& leg = robot.legs[0];
  const Posture posture = SolvePosture(robot, mid.value);
  ASSERT_TRUE(posture.reachable);
  const Eigen::Vector3d place_B = leg.hip_B + outwards;
  robot = WithDot(2, posture.frames[0].X_BLink[2].inverse() * place_B);
  const Eigen::Vector2d hip = leg.hip_B.head<2>();
  const Eigen::Vector2d velocity =
      -turn * Across(hip) - (turn + more) * Across(Eigen::Vector2d(outwards.head<2>()));
  mid.first.segment<2>(kComX) = velocity;
  mid.first[kWaistYaw] = turn;
  for (Side side : {Side::kLeft, Side::kRight}) {
    const Eigen::Vector2d ankle = mid.value.segment<2>(FootIndex(side));
    mid.first.segment<2>(FootIndex(side)) = velocity + turn * Across(ankle);
    mid.first[FootIndex(side) + 3] = side == Side::kLeft ? turn + more : turn;
  }
  EXPECT_GT(ShareAtTheEnd(robot, mid, 2e-3, Bounded::kDisplacement, 0), 0.75);
}

// A dot beside the sole, which goes round the waist against the waist's own turn, is at rest seen
// from the waist.
TEST(MotionBounds, NeedTheCoriolisTermOfASoleSeenFromATurningWaist) {
  const double turn = 1.0, more = 2.0;
  RobotModel robot = WithDot(5, {0, 0, 0});
  WalkJet mid = Upright(robot);
  const Eigen::Vector2d d = mid.value.segment<2>(kLeftX);
  const Posture posture = SolvePosture(robot, mid.value);
  ASSERT_TRUE(posture.reachable);
  const Eigen::Vector2d beside = 2.0 * turn / more * d;
  const Eigen::Vector3d place_W =
      posture.X_WSole[0].translation() + Eigen::Vector3d(beside.x(), beside.y(), 0);
  robot = WithDot(5, posture.X_WLink[0][5].inverse() * place_W);
  mid.first[kWaistYaw] = turn;
  mid.first.segment<2>(kLeftX) = -turn * Across(d);
  mid.first[kLeftYaw] = turn + more;
  EXPECT_GT(ShareAtTheEnd(robot, mid, 2e-3, Bounded::kDisplacementB, 0), 0.85);
}

// The hip goes ahead above a sole that turns: seen from there it curves, and the ankle must roll.
TEST(MotionBounds, NeedTheCoriolisTermOfAHipSeenFromATurningSole) {
  const RobotModel robot = WithDot(2, {0, 0, 0});
  WalkJet mid = Upright(robot);
  mid.first[kComX] = 0.05;
  mid.first[kLeftYaw] = 3.0;
  EXPECT_GT(ShareAtTheEnd(robot, mid, 1e-3, Bounded::kJointRate, 5), 0.75);
}

}  // namespace
}  // namespace halfstep
