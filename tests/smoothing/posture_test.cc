#include "wpg/motion/posture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "opt/problem/derivative_check.h"
#include "smoothing/walk/superposed_walk.h"
#include "tests/smoothing/test_walks.h"

namespace halfstep {
namespace {

double Difference(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff();
}

class PostureTest : public testing::Test {
 protected:
  // Instants of random walks at which both legs reach, `reach` [m] or more from stretched.
  template <typename Use>
  int ForRandomInstants(int count, double reach, const Use& use) {
    int reached = 0;
    for (int i = 0; i < count; ++i) {
      const HalfStepSequence sequence = draw_.Sequence(3);
      const SuperposedWalk walk(sequence, draw_.ExtremeParameters(sequence));
      const double t = draw_.Uniform(0, walk.duration());
      const Posture posture = SolvePosture(robot_, walk.At(t).value);
      if (!posture.reachable || posture.ik[0].reach_margin < reach ||
          posture.ik[1].reach_margin < reach || NearKnot(walk, t, 3e-4)) {
        continue;
      }
      ++reached;
      use(walk, t, posture);
    }
    return reached;
  }

  const RobotModel robot_ = Hrp2();
  WalkDraw draw_{50};
};

TEST_F(PostureTest, TheStandingPostureIsTheRobotsOwn) {
  WalkState x = WalkState::Zero();
  const double half = 0.5 * robot_.standing_width;
  x[kLeftY] = half, x[kRightY] = -half;
  const Posture stand = SolvePosture(robot_, x);
  ASSERT_TRUE(stand.reachable);
  EXPECT_NEAR(stand.X_WB.translation().z(), robot_.waist_height, 1e-15);
  EXPECT_NEAR(stand.X_WB.translation().x(), -robot_.com_x_B, 1e-15);
  // The soles are under the CoM here, wherever they are under the waist in half-sitting.
  const double shift = robot_.com_x_B;
  for (size_t s = 0; s < 2; ++s) {
    const Leg& leg = robot_.legs[s];
    const double sole_x = LegForwardKinematics(leg, leg.standing_q)[6].translation().x();
    WalkState half_sitting = x;
    half_sitting[kComX] = shift - sole_x;
    const Posture posture = SolvePosture(robot_, half_sitting);
    EXPECT_LT((posture.ik[s].q - leg.standing_q).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST_F(PostureTest, LinksJoinTheWaistToTheSolesOfTheWalk) {
  const int reached =
      ForRandomInstants(1000, 0.0, [&](const SuperposedWalk& walk, double t, Posture posture) {
        const WalkState x = walk.At(t).value;
        for (Side side : {Side::kLeft, Side::kRight}) {
          const size_t s = static_cast<size_t>(Index(side));
          const Eigen::Isometry3d X_WSole = ToIsometry(FootPose(x, side), x[FootIndex(side) + 2]);
          EXPECT_LT(Difference(posture.X_WSole[s], X_WSole), 1e-15);
          EXPECT_LT(Difference(posture.X_WLink[s][6], X_WSole), 1e-12);
        }
        // The CoM is rigid ahead of the waist, which is upright at constant height.
        const Eigen::Vector3d com = posture.X_WB * Eigen::Vector3d(robot_.com_x_B, 0, 0);
        EXPECT_LT((com - Eigen::Vector3d(x[kComX], x[kComY], robot_.waist_height)).norm(), 1e-14);
        EXPECT_LT((posture.X_WB.linear().col(2) - Eigen::Vector3d::UnitZ()).norm(), 1e-15);
        EXPECT_NEAR(
            std::remainder(std::atan2(posture.X_WB(1, 0), posture.X_WB(0, 0)) - x[kWaistYaw],
                           2 * M_PI),
            0, 1e-12);
      });
  EXPECT_GT(reached, 300);
}

TEST_F(PostureTest, JointSpeedsAreTheTimeDerivativeOfJointAngles) {
  double worst = 0;
  const int reached = ForRandomInstants(
      Draws(1000), 0.01, [&](const SuperposedWalk& walk, double t, Posture posture) {
        ASSERT_TRUE(SolveJointSpeeds(robot_, walk.At(t), &posture));
        const auto angles = [&](const Eigen::VectorXd& dt) -> Eigen::VectorXd {
          const Posture moved = SolvePosture(robot_, walk.At(t + dt[0]).value);
          Eigen::VectorXd q(12);
          q << moved.ik[0].q, moved.ik[1].q;
          return q;
        };
        Eigen::VectorXd speeds(12);
        speeds << posture.speeds[0], posture.speeds[1];
        const auto report = CheckJacobian(angles, Eigen::VectorXd::Zero(1), speeds);
        worst = std::max(worst, report.worst_error);
        EXPECT_TRUE(report.Passed(1e-7)) << report.Describe();
        Eigen::Index row;
        if (speeds.cwiseAbs().maxCoeff(&row) < 0.01) return;
        Eigen::VectorXd wrong = speeds;
        wrong[row] *= 1.01;
        EXPECT_FALSE(CheckJacobian(angles, Eigen::VectorXd::Zero(1), wrong).Passed(1e-7));
      });
  EXPECT_GT(reached, Draws(300));
  RecordProperty("worst_1e15", static_cast<int>(1e15 * worst));
}

TEST_F(PostureTest, AFootTooFarAwayIsNotReached) {
  WalkState x = WalkState::Zero();
  x[kLeftY] = 0.105, x[kRightY] = -0.105;
  x[kRightX] = 0.6;
  const Posture posture = SolvePosture(robot_, x);
  EXPECT_FALSE(posture.reachable);
  EXPECT_EQ(posture.ik[0].status, LegIkStatus::kSolved);
  EXPECT_LT(posture.ik[1].reach_margin, 0.0);
}

}  // namespace
}  // namespace halfstep
