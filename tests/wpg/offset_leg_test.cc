#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include "tests/wpg/generated_robots.h"
#include "tests/wpg/hrp2.h"
#include "tests/wpg/leg_differences.h"
#include "tests/wpg/random_direction.h"
#include "wpg/robot/leg_continuation.h"
#include "wpg/robot/leg_ik.h"
#include "wpg/robot/leg_neighbourhood.h"
#include "wpg/robot/offset_leg_bound.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using testing::HasSubstr;

Isometry3d LevelSole(const Eigen::Vector4d& xyz_yaw) {
  Isometry3d X = Isometry3d::Identity();
  X.translation() = xyz_yaw.head<3>();
  X.rotate(Eigen::AngleAxisd(xyz_yaw[3], Vector3d::UnitZ()));
  return X;
}

class OffsetLegTest : public testing::TestWithParam<int> {
 protected:
  OffsetLegTest()
      : robot_(TemporaryRobot(OffsetRobots()[static_cast<size_t>(GetParam())]).Load()),
        size_(robot_.waist_height / 0.65) {}

  // x, y, z, yaw of a sole about where it stands, as walking asks for it.
  Eigen::Vector4d DrawSole(const Leg& leg) {
    std::uniform_real_distribution<> unit(-1, 1);
    Eigen::Vector4d sole;
    sole << LegForwardKinematics(leg, leg.standing_q)[6].translation(), 0.4 * unit(random_);
    sole.head<3>() +=
        size_ * Vector3d(0.25 * unit(random_), 0.12 * unit(random_), 0.09 * (1 + unit(random_)));
    return sole;
  }

  RobotModel robot_;
  double size_;  // of the robot, HRP-2: 1
  std::mt19937 random_{20261123};
};

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

// What is claimed of the neighbourhood of a posture, at random postures in it.
TEST_P(OffsetLegTest, NeighbourhoodHoldsWhatItClaims) {
  const Leg& leg = robot_.legs[0];
  std::uniform_real_distribution<> unit(-1, 1);
  double nearest = 0;
  for (int k = 0; k < 300; ++k) {
    const LegIkSolution solution = SolveLegIk(leg, LevelSole(DrawSole(leg)));
    if (solution.status != LegIkStatus::kSolved) continue;
    const auto near = LegNeighbourhood::Around(leg, solution.q);
    ASSERT_TRUE(near);
    Vector6d radius, speeds;
    for (int j = 0; j < 6; ++j) radius[j] = 0.1 * std::abs(unit(random_));
    for (int j = 0; j < 6; ++j) speeds[j] = unit(random_);
    Vector6d q = solution.q;
    for (int j = 0; j < 6; ++j) q[j] += unit(random_) > 0 ? radius[j] : -radius[j];
    // About the hip, as the neighbourhood has it.
    const auto jacobian = [&](const Vector6d& at) {
      const LegFrames frames = PlaceLeg(leg, at);
      Matrix6d J;
      for (size_t j = 0; j < 6; ++j) {
        J.col(static_cast<Eigen::Index>(j)) << frames.axis_B[j],
            frames.axis_B[j].cross(leg.hip_B - frames.point_B[j]);
      }
      return J;
    };
    const Matrix6d change = near->inverse() * (jacobian(q) - jacobian(solution.q));
    const Matrix6d bound = near->Change(radius);
    EXPECT_LE((change.cwiseAbs() - bound).maxCoeff(), 1e-12);
    nearest = std::max(nearest, (change.cwiseAbs().array() / (bound.array() + 1e-9)).maxCoeff());
    const double h = 1e-6;
    const Vector6d bending =
        near->inverse() * (jacobian(q + h * speeds) - jacobian(q - h * speeds)) / (2 * h) * speeds;
    EXPECT_LE((bending.cwiseAbs() - near->Bending(speeds.cwiseAbs(), radius)).maxCoeff(), 1e-6);
    const Vector6d here = near->inverse() *
                          (jacobian(solution.q + h * speeds) - jacobian(solution.q - h * speeds)) /
                          (2 * h) * speeds;
    EXPECT_LT((near->Bend(speeds) + here).norm(), 1e-5 * (1 + here.norm()));
  }
  EXPECT_GT(nearest, 0.9) << "so near that a term forgotten would show";
}

// The leg with a share of its offsets, as it is on the way from the closed-form one.
Leg AtShare(const Leg& leg, double share) {
  Leg between = leg;
  const Leg& met = leg.met.front();
  for (size_t j = 0; j < 6; ++j) {
    between.joints[j].point_B = met.AxisPoint(j) + share * (leg.AxisPoint(j) - met.AxisPoint(j));
  }
  between.X_BSole.translation() +=
      (1 - share) * (met.X_BSole.translation() - leg.X_BSole.translation());
  return between;
}

// Twists of the joints about the hip, as the neighbourhood has them.
Matrix6d HipJacobian(const Leg& leg, const Vector6d& q) {
  const LegFrames frames = PlaceLeg(leg, q);
  Matrix6d J;
  for (size_t j = 0; j < 6; ++j) {
    J.col(static_cast<Eigen::Index>(j)) << frames.axis_B[j],
        frames.axis_B[j].cross(leg.hip_B - frames.point_B[j]);
  }
  return J;
}

// How the twist of joint j changes when joint l before it turns.
Vector6d Bracket(const Vector6d& l, const Vector6d& j) {
  const Vector3d turn = l.head<3>(), swing = l.tail<3>();
  Vector6d bracket;
  bracket << turn.cross(Vector3d(j.head<3>())),
      turn.cross(Vector3d(j.tail<3>())) + swing.cross(Vector3d(j.head<3>()));
  return bracket;
}

// J⁻¹·vee(∂F/∂q·F(here)⁻¹) − 1 for the sole's pose F at q.
Matrix6d PoseChangeAt(const Leg& leg, const Matrix6d& inverse, const Isometry3d& here,
                      const Vector6d& q) {
  const Isometry3d moved = LegForwardKinematics(leg, q)[6] * here.inverse();
  const Vector3d d = moved * leg.hip_B - leg.hip_B;
  Matrix6d twists = HipJacobian(leg, q);
  for (int j = 0; j < 6; ++j) {
    const Vector3d turn = twists.col(j).head<3>();
    Eigen::Matrix3d of_turn;
    of_turn << 0, -turn.z(), turn.y(), turn.z(), 0, -turn.x(), -turn.y(), turn.x(), 0;
    const Eigen::Matrix3d A = of_turn * moved.linear();
    twists.col(j) << 0.5 * Vector3d(A(2, 1) - A(1, 2), A(0, 2) - A(2, 0), A(1, 0) - A(0, 1)),
        turn.cross(d) + Vector3d(twists.col(j).tail<3>());
  }
  return inverse * twists - Matrix6d::Identity();
}

// The same and more with few joints that turn, and on the way from the closed form: then no term
// hides behind others.
TEST_P(OffsetLegTest, NeighbourhoodHoldsWhatItClaimsOfFewJoints) {
  const Leg& leg = robot_.legs[0];
  std::uniform_real_distribution<> unit(-1, 1), share_of(0, 1);
  const auto sparse = [&](double most) {
    return share_of(random_) < 0.6 ? 0.0 : most * std::pow(10, -3 * share_of(random_));
  };
  double nearest = 0, nearest_bending = 0, nearest_pose = 0;
  for (int k = 0; k < 4000; ++k) {
    const LegIkSolution solution = SolveLegIk(leg, LevelSole(DrawSole(leg)));
    if (solution.status != LegIkStatus::kSolved) continue;
    const double share = k % 2 == 0 ? 1.0 : share_of(random_);
    const double other = k % 4 < 2 ? share : share_of(random_);
    const auto near = LegNeighbourhood::Around(leg, solution.q, share);
    if (!near) continue;
    Vector6d radius, speeds, q = solution.q;
    for (int j = 0; j < 6; ++j) {
      radius[j] = sparse(0.7), speeds[j] = sparse(1.0);
      q[j] += unit(random_) > 0 ? radius[j] : -radius[j];
      if (unit(random_) > 0) speeds[j] = -speeds[j];
    }
    const Leg here = AtShare(leg, share);
    const Matrix6d J = HipJacobian(here, solution.q);
    ASSERT_LT((near->inverse() * J - Matrix6d::Identity()).norm(), 1e-9);
    const auto compare = [](const auto& truth, const auto& bound, double* most) {
      EXPECT_LE((truth.cwiseAbs() - bound).maxCoeff(), 1e-11);
      *most = std::max(*most, (truth.cwiseAbs().array() / (bound.array() + 1e-9)).maxCoeff());
    };
    const Matrix6d there = HipJacobian(AtShare(leg, other), q);
    compare(Matrix6d(near->inverse() * (there - J)), near->Change(radius, std::abs(other - share)),
            &nearest);
    const Matrix6d at_q = HipJacobian(here, q);
    Vector6d bending = Vector6d::Zero();
    for (int j = 1; j < 6; ++j) {
      for (int l = 0; l < j; ++l) {
        bending += speeds[l] * speeds[j] * Bracket(at_q.col(l), at_q.col(j));
      }
    }
    compare(Vector6d(near->inverse() * bending), near->Bending(speeds.cwiseAbs(), radius),
            &nearest_bending);
    if (share == 1.0 && radius.sum() < 0.5) {
      compare(PoseChangeAt(leg, near->inverse(), near->X_BSole(), q), near->PoseChange(radius),
              &nearest_pose);
    }
    Vector6d twist = Vector6d::Zero();
    twist[2] = unit(random_) < 0 ? 0.0 : 0.7;
    if (unit(random_) < 0) twist.tail<3>() = Vector3d(unit(random_), unit(random_), unit(random_));
    double asked = 0;
    compare(Vector6d(near->inverse() * twist), near->Asked(twist[2], twist.tail<3>().norm()),
            &asked);
    // A sole that may have turned by more has no proof.
    const double sum = radius.sum();
    if (sum > 0) {
      for (const double wide : {0.51, 1.01, 1.5, 5.0}) {
        EXPECT_FALSE(near->InjectiveWithin(wide / sum * radius));
      }
      const Vector6d narrow = 0.49 / sum * radius;
      if (near->InjectiveWithin(narrow)) {
        EXPECT_TRUE(Contraction::Of(near->PoseChange(narrow)));
      }
    }
  }
  EXPECT_GT(nearest, 0.95);
  EXPECT_GT(nearest_bending, 0.95);
  EXPECT_GT(nearest_pose, 0.95);
}

// A posture with that pose, from a near one; none where Newton's method does not find it.
std::optional<Vector6d> Meet(const Leg& leg, const Isometry3d& X, Vector6d q) {
  for (int k = 0; k < 12; ++k) {
    const Isometry3d left = X * LegForwardKinematics(leg, q)[6].inverse();
    const Eigen::AngleAxisd turn(left.linear());
    Vector6d twist;
    twist << turn.angle() * turn.axis(), left * leg.hip_B - leg.hip_B;
    if (twist.norm() < 1e-12) return q;
    q += HipJacobian(leg, q).partialPivLu().solve(twist);
    if (!q.allFinite()) return std::nullopt;
  }
  return std::nullopt;
}

// Along ways of the sole, and of the offsets, that turn and go straight about the hip.
TEST_P(OffsetLegTest, WaysHoldWhatJointsDoAlongTheLift) {
  const Leg& leg = robot_.legs[0];
  constexpr int kParts = 8;
  std::uniform_real_distribution<> unit(-1, 1), share_of(0, 1);
  int proved = 0;
  double nearest = 0;
  for (int k = 0; k < 400; ++k) {
    const LegIkSolution solution = SolveLegIk(leg, LevelSole(DrawSole(leg)));
    if (solution.status != LegIkStatus::kSolved) continue;
    const bool by_share = k % 3 == 0, moves = k % 3 > 0 || k % 2 == 0;
    const double from = by_share ? share_of(random_) : 1.0;
    const double share = by_share ? (1.0 - from) * share_of(random_) : 0.0;
    const auto near = LegNeighbourhood::Around(leg, solution.q, from);
    if (!near) continue;
    Vector6d twist = Vector6d::Zero();
    if (moves) {
      const double size = std::pow(10, -2.5 * share_of(random_));
      for (double& x : twist) x = unit(random_) < 0.5 ? 0.0 : size * unit(random_);
    }
    const Vector6d straight = near->inverse() * twist;
    const auto ways = near->Ways(straight.cwiseAbs(), share);
    if (!ways) continue;
    ++proved;
    Vector6d q = solution.q, way = Vector6d::Zero();
    for (int part = 1; part <= kParts; ++part) {
      const double s = static_cast<double>(part) / kParts, angle = s * twist.head<3>().norm();
      // exp of the twist: a screw.
      Eigen::Matrix4d of_twist = Eigen::Matrix4d::Zero();
      of_twist(2, 1) = twist[0], of_twist(1, 2) = -twist[0], of_twist(0, 2) = twist[1];
      of_twist(2, 0) = -twist[1], of_twist(1, 0) = twist[2], of_twist(0, 1) = -twist[2];
      of_twist.topRightCorner<3, 1>() = twist.tail<3>();
      Eigen::Matrix4d power = Eigen::Matrix4d::Identity(), exponential = power;
      for (int n = 1; n < 20 + static_cast<int>(10 * angle); ++n) {
        power = power * of_twist * s / n;
        exponential += power;
      }
      const Eigen::Translation3d hip(leg.hip_B);
      const Isometry3d moved = hip * Isometry3d(exponential) * hip.inverse();
      const auto next = Meet(AtShare(leg, from + s * share), moved * near->X_BSole(), q);
      ASSERT_TRUE(next) << "there is a lift";
      way += (*next - q).cwiseAbs();
      q = *next;
    }
    EXPECT_LE((way - *ways).maxCoeff(), 1e-9);
    const Vector6d bent = (q - solution.q - share * near->by_share() - straight).cwiseAbs();
    const Vector6d may = *ways - straight.cwiseAbs() - share * near->by_share().cwiseAbs();
    EXPECT_LE((bent - may).maxCoeff(), 1e-9);
    nearest = std::max(nearest, (way.array() / (ways->array() + 1e-9)).maxCoeff());
  }
  EXPECT_GT(proved, 100);
  EXPECT_GT(nearest, 0.95);
}

// A leg that may be out of reach within the interval has no proof over it: straight down, by speed
// or by acceleration, beyond where it is stretched.
TEST_P(OffsetLegTest, ThereIsNoProofOfAnIntervalInWhichTheLegIsStretched) {
  const Leg& leg = robot_.legs[0];
  const double h = 0.01;
  Isometry3d X = LegForwardKinematics(leg, leg.standing_q)[6];
  while (SolveLegIk(leg, X).reach_margin > 0.02 * size_) X.translation().z() -= 1e-3 * size_;
  const auto proved = [&](const SoleDrift& drift) { return ContinueLeg(leg, X, drift).arrived; };
  const double out = 0.05 * size_;  // [m]
  EXPECT_TRUE(proved({}));
  EXPECT_TRUE(proved({.half_width = h, .velocity = {0, 0, -1e-3}, .acceleration = 1e-3}));
  EXPECT_FALSE(proved({.half_width = h, .velocity = {0, 0, -out / h}}));
  EXPECT_FALSE(proved({.half_width = h, .acceleration = 2 * out / (h * h)}));
  // A turn on the spot takes the hip's side out of reach of axes that are not vertical.
  EXPECT_FALSE(proved({.half_width = h, .yaw_rate = 3.0 / h}));
  EXPECT_FALSE(proved({.half_width = h, .yaw_acceleration = 6.0 / (h * h)}));
}

// sup |dV/dt| of V = v + ψ̇ẑ×(about − p), against instants of motions that keep the drift.
TEST(SoleDrift, BoundsTheRateOfTheTwist) {
  std::mt19937 random(7);
  std::uniform_real_distribution<> unit(-1, 1), part(0, 1);
  double nearest = 0, excess = -1;
  for (int k = 0; k < 20000; ++k) {
    const auto sparse = [&](double most) { return unit(random) < 0.2 ? 0.0 : most * part(random); };
    const SoleDrift drift{.half_width = 0.05,
                          .velocity = sparse(2) * RandomDirection(&random),
                          .yaw_rate = sparse(5),
                          .acceleration = sparse(40),
                          .yaw_acceleration = sparse(100)};
    const Vector3d about = sparse(0.5) * RandomDirection(&random), p(0, 0, 0);
    // Constant accelerations, level or not.
    const double t = unit(random) < 0 ? -drift.half_width : drift.half_width;
    const Vector3d push = drift.acceleration * RandomDirection(&random), z(0, 0, 1);
    const double turn = (unit(random) < 0 ? -1 : 1) * drift.yaw_acceleration;
    const Vector3d velocity = drift.velocity + t * push;
    const Vector3d place = p + t * drift.velocity + 0.5 * t * t * push;
    const double yaw_rate = drift.yaw_rate + t * turn;
    const Vector3d rate = push + turn * z.cross(about - place) - yaw_rate * z.cross(velocity);
    const double bound = drift.TwistRate(about, p);
    excess = std::max(excess, rate.norm() - bound);
    if (bound > 0) nearest = std::max(nearest, rate.norm() / bound);
  }
  EXPECT_LT(excess, 1e-12);
  EXPECT_GT(nearest, 0.99);
}

TEST(Contraction, IsThereOnlyBelowASpectralRadiusOfOne) {
  std::mt19937 random(8);
  std::uniform_real_distribution<> part(0, 1);
  for (int k = 0; k < 300; ++k) {
    Matrix6d M;
    for (double& entry : M.reshaped()) entry = part(random) < 0.4 ? 0.0 : part(random);
    const double radius = M.eigenvalues().cwiseAbs().maxCoeff();
    if (!(radius > 0.1)) continue;
    EXPECT_FALSE(Contraction::Of(Matrix6d(1.02 / radius * M)));
    const Matrix6d less = 0.8 / radius * M;
    const auto found = Contraction::Of(less);
    if (!found) continue;
    const Vector6d u = Vector6d::Unit(k % 6);
    const Vector6d exact = (Matrix6d::Identity() - less).partialPivLu().solve(u);
    const Vector6d resolved = found->Resolve(less, u);
    EXPECT_GE((resolved - exact).minCoeff(), -1e-12);
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
