// What is claimed of all postures of a leg with offset axes near one, and of its ways from there.

#include "wpg/robot/leg_neighbourhood.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "tests/wpg/leg_differences.h"
#include "tests/wpg/offset_leg_fixture.h"
#include "tests/wpg/random_direction.h"
#include "wpg/robot/leg_continuation.h"
#include "wpg/robot/offset_leg_bound.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

class LegNeighbourhoodTest : public OffsetLegTest {};

// Compiled once: Eigen unrolls each of them.
Matrix6d Times(const Matrix6d& A, const Matrix6d& B) { return A * B; }
Vector6d Applied(const Matrix6d& A, const Vector6d& v) { return A * v; }
Vector6d Solved(const Matrix6d& A, const Vector6d& b) { return A.partialPivLu().solve(b); }
double Largest(const Vector6d& v) { return v.maxCoeff(); }
double Largest(const Matrix6d& A) { return A.maxCoeff(); }
// By how much the truth exceeds what is claimed, and the largest part of a claim that it has.
template <typename Matrix>
double Excess(const Matrix& truth, const Matrix& bound) {
  return Largest(Matrix(truth.cwiseAbs() - bound));
}
template <typename Matrix>
double Part(const Matrix& truth, const Matrix& bound) {
  return Largest(Matrix(truth.cwiseAbs().array() / (bound.array() + 1e-9)));
}

// Of a matrix without negative entries: lim ‖(M + 1)ⁿ‖^(1/n) − 1, by squaring.
double SpectralRadius(const Matrix6d& M) {
  Matrix6d power = M + Matrix6d::Identity();
  double logarithm = 0.0;
  for (int k = 0; k < 40; ++k) {
    const double norm = power.norm();
    logarithm += std::log(norm) / std::pow(2.0, k);
    power = Times(power / norm, power / norm);
  }
  return std::exp(logarithm) - 1.0;
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

// What is claimed of the neighbourhood of a posture, at random postures in it.
TEST_P(LegNeighbourhoodTest, NeighbourhoodHoldsWhatItClaims) {
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
    const Matrix6d change =
        Times(near->inverse(), HipJacobian(leg, q) - HipJacobian(leg, solution.q));
    const Matrix6d bound = near->Change(radius);
    EXPECT_LE(Excess(change, bound), 1e-12);
    nearest = std::max(nearest, Part(change, bound));
    const double h = 1e-6;
    const auto bending_at = [&](const Vector6d& at) {
      const Matrix6d ahead = HipJacobian(leg, at + h * speeds);
      const Matrix6d rate = (ahead - HipJacobian(leg, at - h * speeds)) / (2 * h);
      return Applied(near->inverse(), Applied(rate, speeds));
    };
    const Vector6d bending = bending_at(q), here = bending_at(solution.q);
    EXPECT_LE(Excess(bending, near->Bending(speeds.cwiseAbs(), radius)), 1e-6);
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
  return Times(inverse, twists) - Matrix6d::Identity();
}

// The same and more with few joints that turn, and on the way from the closed form: then no term
// hides behind others.
TEST_P(LegNeighbourhoodTest, NeighbourhoodHoldsWhatItClaimsOfFewJoints) {
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
    ASSERT_LT((Times(near->inverse(), J) - Matrix6d::Identity()).norm(), 1e-9);
    const auto compare = [](const auto& truth, const auto& bound, double* most) {
      EXPECT_LE(Excess(truth, bound), 1e-11);
      *most = std::max(*most, Part(truth, bound));
    };
    const Matrix6d there = HipJacobian(AtShare(leg, other), q);
    compare(Times(near->inverse(), there - J), near->Change(radius, std::abs(other - share)),
            &nearest);
    const Matrix6d at_q = HipJacobian(here, q);
    Vector6d bending = Vector6d::Zero();
    for (int j = 1; j < 6; ++j) {
      for (int l = 0; l < j; ++l) {
        bending += speeds[l] * speeds[j] * Bracket(at_q.col(l), at_q.col(j));
      }
    }
    compare(Applied(near->inverse(), bending), near->Bending(speeds.cwiseAbs(), radius),
            &nearest_bending);
    if (share == 1.0 && radius.sum() < 0.5) {
      compare(PoseChangeAt(leg, near->inverse(), near->X_BSole(), q), near->PoseChange(radius),
              &nearest_pose);
    }
    Vector6d twist = Vector6d::Zero();
    twist[2] = unit(random_) < 0 ? 0.0 : 0.7;
    if (unit(random_) < 0) twist.tail<3>() = Vector3d(unit(random_), unit(random_), unit(random_));
    double asked = 0;
    compare(Applied(near->inverse(), twist), near->Asked(twist[2], twist.tail<3>().norm()), &asked);
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
    q += Solved(HipJacobian(leg, q), twist);
    if (!q.allFinite()) return std::nullopt;
  }
  return std::nullopt;
}

// Along ways of the sole, and of the offsets, that turn and go straight about the hip.
TEST_P(LegNeighbourhoodTest, WaysHoldWhatJointsDoAlongTheLift) {
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
    const Vector6d straight = Applied(near->inverse(), twist);
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
    EXPECT_LE(Largest(Vector6d(way - *ways)), 1e-9);
    const Vector6d bent = (q - solution.q - share * near->by_share() - straight).cwiseAbs();
    const Vector6d may = *ways - straight.cwiseAbs() - share * near->by_share().cwiseAbs();
    EXPECT_LE(Largest(Vector6d(bent - may)), 1e-9);
    nearest = std::max(nearest, Part(way, *ways));
  }
  EXPECT_GT(proved, 100);
  EXPECT_GT(nearest, 0.95);
}

// A leg that may be out of reach within the interval has no proof over it: straight down, by speed
// or by acceleration, beyond where it is stretched.
TEST_P(LegNeighbourhoodTest, ThereIsNoProofOfAnIntervalInWhichTheLegIsStretched) {
  const Leg& leg = robot_.legs[0];
  const double h = 0.01;
  Isometry3d X = LegForwardKinematics(leg, leg.standing_q)[6];
  while (SolveLegIk(leg, X).reach_margin > 0.02 * size_) X.translation().z() -= 1e-3 * size_;
  const Vector6d q = SolveLegIk(leg, X).q;
  const auto proved = [&](const SoleDrift& drift) {
    return StaysInBranch(leg, X, drift, q, Vector6d::Zero());
  };
  const double out = 0.05 * size_;  // [m]
  EXPECT_TRUE(proved({}));
  EXPECT_TRUE(proved({.half_width = h, .velocity = {0, 0, -1e-3}, .acceleration = 1e-3}));
  EXPECT_FALSE(proved({.half_width = h, .velocity = {0, 0, -out / h}}));
  EXPECT_FALSE(proved({.half_width = h, .acceleration = 2 * out / (h * h)}));
  // A turn on the spot takes the hip's side out of reach of axes that are not vertical.
  EXPECT_FALSE(proved({.half_width = h, .yaw_rate = 3.0 / h}));
  EXPECT_FALSE(proved({.half_width = h, .yaw_acceleration = 6.0 / (h * h)}));
  // As little where rounding may have done as much, at m or since.
  const LegRounding::OfSole little{.turn = 1e-9, .place = 1e-9}, much{.turn = 1.0, .place = out};
  EXPECT_TRUE(proved({.half_width = h, .pose_off = little, .twist_off = little}));
  EXPECT_FALSE(proved({.pose_off = much}));
  EXPECT_FALSE(proved({.half_width = h, .twist_off = {.turn = 1.0 / h, .place = out / h}}));
}

// Angles that may be others than those of the branch are refused: another posture, and where
// rounding may do more than a box is wider.
TEST_P(LegNeighbourhoodTest, OnlyAnglesOfTheBranchStayInIt) {
  const Leg& leg = robot_.legs[0];
  const Isometry3d X = LegForwardKinematics(leg, leg.standing_q)[6];
  const Vector6d q = SolveLegIk(leg, X).q, none = Vector6d::Zero();
  EXPECT_TRUE(StaysInBranch(leg, X, {}, q, none));
  EXPECT_TRUE(StaysInBranch(leg, X, {}, q, Vector6d::Constant(1e-9)));
  for (int j = 0; j < 6; ++j) {
    EXPECT_FALSE(StaysInBranch(leg, X, {}, q + 0.5 * Vector6d::Unit(j), none)) << j;
    EXPECT_FALSE(StaysInBranch(leg, X, {}, q, 0.5 * Vector6d::Unit(j))) << j;
    Vector6d unbounded = none;
    unbounded[j] = HUGE_VAL;
    EXPECT_FALSE(StaysInBranch(leg, X, {}, q, unbounded)) << j;
  }
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
    const double radius = SpectralRadius(M);
    if (!(radius > 0.1)) continue;
    EXPECT_FALSE(Contraction::Of(Matrix6d(1.02 / radius * M)));
    const Matrix6d less = 0.8 / radius * M;
    const auto found = Contraction::Of(less);
    if (!found) continue;
    const Vector6d u = Vector6d::Unit(k % 6);
    const Vector6d exact = Solved(Matrix6d::Identity() - less, u);
    const Vector6d resolved = found->Resolve(less, u);
    EXPECT_GE((resolved - exact).minCoeff(), -1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, LegNeighbourhoodTest, testing::Range(0, 3), [](const auto& robot) {
  return OffsetRobots()[static_cast<size_t>(robot.param)].name;
});

}  // namespace
}  // namespace halfstep
