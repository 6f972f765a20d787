#include "wpg/robot/leg_ik.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/wpg/generated_robots.h"
#include "tests/wpg/leg_differences.h"
#include "tests/wpg/shipped_robots.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

class LegIkTest : public testing::TestWithParam<size_t> {
 protected:
  // The shipped robots, then the generated ones.
  LegIkTest() {
    if (GetParam() < kShippedRobots.size()) {
      legs_ = ShippedRobot(kShippedRobots[GetParam()]).legs;
    } else {
      const GeneratedRobot robot = GeneratedRobots()[GetParam() - kShippedRobots.size()];
      legs_ = {MakeLeg(robot, Side::kLeft), MakeLeg(robot, Side::kRight)};
    }
  }

  Vector6d RandomPosture(const Leg& leg) {
    Vector6d q;
    for (size_t i = 0; i < 6; ++i) {
      q[static_cast<Eigen::Index>(i)] =
          std::uniform_real_distribution<>(leg.joints[i].lower, leg.joints[i].upper)(random_);
    }
    return q;
  }

  // |det| of the Jacobian relative to the leg's length cubed: 0 where two branches meet.
  static double Regularity(const Leg& leg, const Vector6d& q) {
    const double length =
        (leg.hip_B - leg.joints[3].point_B).norm() + (leg.ankle_B - leg.joints[3].point_B).norm();
    return std::abs(LegJacobian(leg, q).determinant()) / std::pow(length, 3);
  }

  std::array<Leg, 2> legs_;
  std::mt19937 random_{20260101};
};

TEST_P(LegIkTest, InvertsForwardKinematics) {
  for (const Leg& leg : legs_) {
    double worst = 0, sum = 0;
    int count = 0;
    for (int k = 0; k < 2000; ++k) {
      const Vector6d q = RandomPosture(leg);
      const Isometry3d X_BSole = LegForwardKinematics(leg, q)[6];
      const LegIkSolution solution = SolveLegIk(leg, X_BSole, LegBranchOf(leg, q));
      ASSERT_EQ(solution.status, LegIkStatus::kSolved) << q.transpose();
      ASSERT_GE(solution.reach_margin, 0);
      const double difference = PoseDifference(LegForwardKinematics(leg, solution.q)[6], X_BSole);
      worst = std::max(worst, difference);
      sum += difference;
      ++count;
      if (Regularity(leg, q) > 1e-3) {
        ASSERT_LT(AngleDifference(solution.q, q), 1e-9);
      }
    }
    EXPECT_LT(worst, 1e-10);
    EXPECT_LT(sum / count, 1e-12);
  }
}

TEST_P(LegIkTest, AllSolutionsAreSolutionsOfTheirBranch) {
  for (const Leg& leg : legs_) {
    size_t most = 0;
    for (int k = 0; k < 300; ++k) {
      const Vector6d q = RandomPosture(leg);
      const Isometry3d X_BSole = LegForwardKinematics(leg, q)[6];
      const std::vector<LegIkBranchSolution> all = SolveLegIkAll(leg, X_BSole);
      most = std::max(most, all.size());
      bool found = false;
      for (const LegIkBranchSolution& solution : all) {
        EXPECT_LT(PoseDifference(LegForwardKinematics(leg, solution.q)[6], X_BSole), 1e-9);
        if (Regularity(leg, solution.q) > 1e-4) {
          EXPECT_EQ(LegBranchOf(leg, solution.q), solution.branch);
        }
        found = found || AngleDifference(solution.q, q) < 1e-6;
      }
      if (Regularity(leg, q) > 1e-4) {
        EXPECT_TRUE(found) << q.transpose();
      }
      for (size_t a = 0; a < all.size() && Regularity(leg, q) > 1e-2; ++a) {
        for (size_t b = 0; b < a; ++b) {
          EXPECT_GT(AngleDifference(all[a].q, all[b].q), 1e-4) << "twice the same";
        }
      }
    }
    EXPECT_EQ(most, 8u);
  }
}

TEST_P(LegIkTest, BranchIsContinuousAlongSmoothMotions) {
  for (const Leg& leg : legs_) {
    int steps = 0;
    for (int motion = 0; motion < 20; ++motion) {
      const Vector6d from = RandomPosture(leg), to = RandomPosture(leg);
      Vector6d before;
      bool has_before = false;
      const LegBranch branch = LegBranchOf(leg, from);
      for (int k = 0; k <= 1000; ++k) {
        const Vector6d q = from + (to - from) * (k / 1000.0);
        if (Regularity(leg, q) < 1e-3) break;  // beyond lies another branch
        const LegIkSolution solution = SolveLegIk(leg, LegForwardKinematics(leg, q)[6], branch);
        ASSERT_EQ(solution.status, LegIkStatus::kSolved);
        ASSERT_LT(AngleDifference(solution.q, q), 1e-9);
        if (has_before) {
          ASSERT_LT(AngleDifference(solution.q, before),
                    (to - from).cwiseAbs().maxCoeff() / 1000 + 1e-9);
          ++steps;
        }
        before = solution.q;
        has_before = true;
      }
    }
    EXPECT_GT(steps, 3000);
  }
}

TEST_P(LegIkTest, JacobianIsTheDerivativeOfForwardKinematics) {
  const double h = 1e-6;
  for (const Leg& leg : legs_) {
    for (int k = 0; k < 50; ++k) {
      const Vector6d q = RandomPosture(leg);
      const Matrix6d J = LegJacobian(leg, q);
      const Isometry3d X = LegForwardKinematics(leg, q)[6];
      for (int i = 0; i < 6; ++i) {
        const Isometry3d ahead = LegForwardKinematics(leg, q + h * Vector6d::Unit(i))[6];
        const Isometry3d behind = LegForwardKinematics(leg, q - h * Vector6d::Unit(i))[6];
        const Vector3d v = (ahead.translation() - behind.translation()) / (2 * h);
        const Eigen::Matrix3d W =
            (ahead.linear() - behind.linear()) / (2 * h) * X.linear().transpose();
        EXPECT_LT((J.col(i).tail<3>() - v).norm(), 1e-8);
        EXPECT_LT((J.col(i).head<3>() - Vector3d(W(2, 1), W(0, 2), W(1, 0))).norm(), 1e-8);
      }
    }
  }
}

// wpg/README.md, "Branches": |det J| is the product of the functions whose signs name the branch.
TEST_P(LegIkTest, JacobianIsSingularExactlyWhereBranchesMeet) {
  for (const Leg& leg : legs_) {
    const auto& j = leg.joints;
    const auto turned = [&](size_t i, double angle, const Vector3d& v) {
      return Vector3d(Eigen::AngleAxisd(angle, j[i].axis_B) * v);
    };
    for (int k = 0; k < 200; ++k) {
      const Vector6d q = RandomPosture(leg);
      const Vector3d hip = leg.hip_B - j[3].point_B, ankle = leg.ankle_B - j[3].point_B;
      const double knee = j[3].axis_B.dot(hip.cross(turned(3, q[3], ankle)));
      const Vector3d hip_seen = turned(4, -q[4], turned(3, -q[3], hip) - ankle);
      const double ankles = j[5].axis_B.cross(j[4].axis_B).dot(hip_seen);
      const double hips = j[0].axis_B.cross(j[1].axis_B).dot(turned(1, q[1], j[2].axis_B));
      EXPECT_NEAR(std::abs(LegJacobian(leg, q).determinant()), std::abs(knee * ankles * hips),
                  1e-14);
    }
  }
}

Isometry3d Upright(const Eigen::Vector4d& xyz_yaw) {
  Isometry3d X = Isometry3d::Identity();
  X.translation() = xyz_yaw.head<3>();
  X.rotate(Eigen::AngleAxisd(xyz_yaw[3], Vector3d::UnitZ()));
  return X;
}

TEST_P(LegIkTest, DerivativeAgreesWithCentralDifferences) {
  const double h = 1e-6;
  int tried = 0;
  for (const Leg& leg : legs_) {
    const Vector3d standing = LegForwardKinematics(leg, leg.standing_q)[6].translation();
    const double size = std::min(1.0, leg.hip_B.z() - standing.z());
    std::uniform_real_distribution<> unit(-1, 1);
    for (int k = 0; k < 200; ++k) {
      Eigen::Matrix<double, 8, 1> p;  // waist x y z yaw, sole x y z yaw
      p << unit(random_), unit(random_), unit(random_), 3 * unit(random_), 0, 0, 0, 0;
      Isometry3d X_BSole = Isometry3d::Identity();
      X_BSole.translation() = standing + size * Vector3d(0.15 * unit(random_), 0.1 * unit(random_),
                                                         0.1 * unit(random_) + 0.08);
      p.segment<3>(4) = Upright(p.head<4>()) * X_BSole.translation();
      p[7] = p[3] + 0.4 * unit(random_);
      const auto solve = [&](const Eigen::Matrix<double, 8, 1>& at) {
        return SolveLegIk(leg, Upright(at.head<4>()).inverse() * Upright(at.tail<4>()));
      };
      const LegIkSolution solution = solve(p);
      if (solution.status != LegIkStatus::kSolved || Regularity(leg, solution.q) < 0.01) continue;
      ++tried;
      Eigen::Matrix<double, 6, 8> dq;
      ASSERT_TRUE(
          LegIkDerivative(leg, solution.q, Upright(p.head<4>()), Upright(p.tail<4>()), &dq));
      for (int i = 0; i < 8; ++i) {
        const Eigen::Matrix<double, 8, 1> step = h * Eigen::Matrix<double, 8, 1>::Unit(i);
        const LegIkSolution ahead = solve(p + step), behind = solve(p - step);
        ASSERT_EQ(ahead.status, LegIkStatus::kSolved);
        ASSERT_EQ(behind.status, LegIkStatus::kSolved);
        for (int j = 0; j < 6; ++j) {
          const double slope =
              std::remainder(ahead.q[j] - behind.q[j], 2 * std::numbers::pi) / (2 * h);
          EXPECT_NEAR(dq(j, i), slope, 1e-6 * (1 + std::abs(slope))) << "row " << j << " col " << i;
        }
      }
    }
  }
  EXPECT_GT(tried, 100);
}

TEST_P(LegIkTest, TooFarAndTooNearAreOutOfReachByTheMargin) {
  const auto& leg = legs_[0];
  Isometry3d X_BSole = LegForwardKinematics(leg, leg.standing_q)[6];
  const double margin = SolveLegIk(leg, X_BSole).reach_margin;
  EXPECT_GT(margin, 0);
  // The hip-ankle distance changes by what the sole moves along that line.
  const Vector3d ankle = X_BSole * (leg.X_BSole.inverse() * leg.ankle_B);
  const Vector3d away = (ankle - leg.hip_B).normalized();
  const auto at = [&](double distance) {
    Isometry3d X = X_BSole;
    X.translation() += distance * away;
    return SolveLegIk(leg, X);
  };
  EXPECT_EQ(at(margin - 1e-6).status, LegIkStatus::kSolved);
  EXPECT_NEAR(at(margin - 1e-6).reach_margin, 1e-6, 1e-12);
  EXPECT_EQ(at(margin + 1e-6).status, LegIkStatus::kOutOfReach);
  EXPECT_NEAR(at(margin + 1e-6).reach_margin, -1e-6, 1e-12);
  EXPECT_NEAR(at(margin + 2).reach_margin, -2, 1e-12);
  EXPECT_TRUE(SolveLegIkAll(leg,
                            [&] {
                              Isometry3d X = X_BSole;
                              X.translation() += (margin + 0.1) * away;
                              return X;
                            }())
                  .empty());
  // Ankle on the hip: nearer than the offsets along the knee axis and unequal shanks allow.
  const double distance = (ankle - leg.hip_B).norm();
  const LegJoint& knee = leg.joints[3];
  const double along = knee.axis_B.dot(leg.ankle_B - leg.hip_B);
  const double nearest =
      std::hypot(along, (leg.hip_B - knee.point_B).cross(knee.axis_B).norm() -
                            (leg.ankle_B - knee.point_B).cross(knee.axis_B).norm());
  if (nearest == 0.0) return;  // thigh and shank fold together
  ASSERT_GT(nearest, 1e-3);
  const LegIkSolution folded = at(-distance);
  EXPECT_EQ(folded.status, LegIkStatus::kOutOfReach);
  EXPECT_NEAR(folded.reach_margin, -nearest, 1e-9);
  EXPECT_TRUE(std::isfinite(folded.reach_margin));
}

TEST_P(LegIkTest, DerivativeRefusesTheStretchedKnee) {
  const auto& leg = legs_[0];
  Isometry3d X = LegForwardKinematics(leg, leg.standing_q)[6];
  const Vector3d ankle = X * (leg.X_BSole.inverse() * leg.ankle_B);
  X.translation() += SolveLegIk(leg, X).reach_margin * (ankle - leg.hip_B).normalized();
  const LegIkSolution stretched = SolveLegIk(leg, X);
  Eigen::Matrix<double, 6, 8> dq = Eigen::Matrix<double, 6, 8>::Constant(7);
  ASSERT_EQ(stretched.status, LegIkStatus::kSolved);
  EXPECT_FALSE(LegIkDerivative(leg, stretched.q, Isometry3d::Identity(), X, &dq));
  EXPECT_EQ(dq, (Eigen::Matrix<double, 6, 8>::Constant(7)));
}

TEST_P(LegIkTest, RightMirrorsLeft) {
  const Eigen::DiagonalMatrix<double, 3> mirror(1, -1, 1);
  for (int k = 0; k < 200; ++k) {
    const Vector6d q = RandomPosture(legs_[0]);
    Isometry3d X = LegForwardKinematics(legs_[0], q)[6];
    X.translation() = mirror * X.translation();
    X.linear() = mirror * X.linear() * mirror;
    Vector6d mirrored;
    for (int i = 0; i < 6; ++i) {
      const auto j = static_cast<size_t>(i);
      const Vector3d axis = mirror * legs_[0].joints[j].axis_B;
      mirrored[i] = axis.dot(legs_[1].joints[j].axis_B) < 0 ? q[i] : -q[i];
    }
    EXPECT_LT(PoseDifference(LegForwardKinematics(legs_[1], mirrored)[6], X), 1e-12);
  }
}

TEST_P(LegIkTest, NotFinitePoseIsABrokenPrecondition) {
  Isometry3d X = legs_[0].X_BSole;
  X.translation().x() = std::nan("");
  EXPECT_THROW((void)SolveLegIk(legs_[0], X), std::logic_error);
}

std::string RobotName(const testing::TestParamInfo<size_t>& robot) {
  const size_t shipped = kShippedRobots.size();
  return robot.param < shipped ? kShippedRobots[robot.param]
                               : GeneratedRobots()[robot.param - shipped].name;
}
INSTANTIATE_TEST_SUITE_P(Robots, LegIkTest, testing::Range(size_t{0}, size_t{6}), RobotName);

}  // namespace
}  // namespace halfstep
