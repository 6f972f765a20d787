// How a leg's joints follow from its knee, as algebra: as in rigid_drift_test.cc.

#include "wpg/motion/knee_match.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>

#include "tests/draws.h"
#include "tests/wpg/algebra_draw.h"
#include "wpg/motion/spatial.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

// Six joints' axes in W, each with its arm to the knee's point, both turned with the links.
struct KneeAxes {
  std::array<Vector3d, 6> axes, points;

  Matrix6d Jacobian(const std::array<Eigen::Matrix3d, 6>& turned) const {
    constexpr std::array<size_t, 6> kFixedIn = {0, 1, 2, 2, 4, 5};
    const auto carried = [&](size_t link, size_t to, size_t from) -> Vector3d {
      return turned[link] * (points[to] - points[from]);
    };
    std::array<Vector3d, 6> arms;
    arms[2] = carried(2, 3, 2);
    arms[1] = arms[2] + carried(1, 2, 1);
    arms[0] = arms[1] + carried(0, 1, 0);
    arms[3].setZero();
    arms[4] = carried(3, 3, 4);
    arms[5] = arms[4] + carried(4, 4, 5);
    Matrix6d J;
    for (size_t j = 0; j < 6; ++j) {
      const Vector3d axis = turned[kFixedIn[j]] * axes[j];
      J.col(static_cast<Eigen::Index>(j)) << axis, axis.cross(arms[j]);
    }
    return J;
  }
};

// Any points and any matrix, so that each distance and each half of its rows is once all that
// counts.
TEST(KneeMatch, HoldsHowMuchTheJacobianChanges) {
  AlgebraDraw draw(7);
  AlgebraTally change;
  for (int i = 0; i < Draws(10000); ++i) {
    IntervalMotion motion;
    Posture& posture = motion.posture;
    posture.X_WB.linear() = draw.Turn(1.0);
    posture.X_WB.translation() = draw.Sparse3(1);
    posture.X_WSole[0].setIdentity();
    posture.X_WSole[0].translation() = draw.Sparse3(1);
    for (Vector3d& point : posture.frames[0].point_B) point = draw.Sparse3(1);
    Matrix6d& inverse = posture.jacobian_inverse[0];
    for (Eigen::Index row = 0; row < 6; ++row) {
      const double turn = draw.Uniform(0, 1) < 0.5 ? 1.0 : 0.0;
      inverse.row(row) << turn * draw.Direction().transpose(), draw.Direction().transpose();
    }
    const KneeMatch knee(motion, Side::kLeft);
    // A twist about the knee's point, about the sole's and in B.
    const Vector3d turn = draw.Sparse3(1), velocity = draw.Sparse3(1);
    const Eigen::Matrix3d& R = posture.X_WB.linear();
    const Vector3d of_sole =
        velocity + turn.cross(posture.X_WSole[0].translation() - knee.points()[3]);
    const Vector6d joints = inverse * Spatial(R.transpose() * turn, R.transpose() * of_sole);
    EXPECT_LT((knee.Joints(turn, velocity) - joints).norm(), 1e-12);
    // Links turn, few of them.
    KneeAxes leg{.axes = {}, .points = knee.points()};
    for (Vector3d& axis : leg.axes) axis = draw.Direction();
    std::array<double, 6> angles;
    std::array<Eigen::Matrix3d, 6> turned, still;
    still.fill(Eigen::Matrix3d::Identity());
    for (size_t link = 0; link < 6; ++link) {
      angles[link] = draw.Sparse(0.1);
      turned[link] = draw.Turn(angles[link]);
    }
    const Matrix6d bound = knee.Change(angles), J = leg.Jacobian(turned) - leg.Jacobian(still);
    for (Eigen::Index j = 0; j < 6; ++j) {
      const Vector6d asked = knee.Joints(J.col(j).head<3>(), J.col(j).tail<3>());
      for (Eigen::Index k = 0; k < 6; ++k) change.Compare(std::abs(asked[k]), bound(k, j), 1.0);
    }
  }
  EXPECT_LT(change.excess, 1.0);
  EXPECT_GT(change.nearest, 0.9);
}

// What solves J(t)·x = r, with r in balls and asked for along each row of J(m)⁻¹, where it counts
// most.
TEST(KneeMatch, HoldsAllSolutionsWhileLinksTurn) {
  AlgebraDraw draw(8);
  AlgebraTally solved, lowered;
  int none = 0;
  for (int i = 0; i < Draws(20000); ++i) {
    IntervalMotion motion;
    Posture& posture = motion.posture;
    posture.X_WB.linear() = draw.Turn(1.0);
    posture.X_WSole[0].setIdentity();
    posture.X_WSole[0].translation() = draw.Sparse3(1);
    for (Vector3d& point : posture.frames[0].point_B) point = draw.Uniform(0, 1) * draw.Direction();
    KneeAxes leg;
    for (size_t j = 0; j < 6; ++j) {
      leg.axes[j] = draw.Direction();
      leg.points[j] = posture.X_WB * posture.frames[0].point_B[j];
    }
    std::array<Eigen::Matrix3d, 6> turned, still;
    still.fill(Eigen::Matrix3d::Identity());
    const Matrix6d J = leg.Jacobian(still), Y = J.inverse();
    if (!(Y.norm() < 100)) continue;
    // Twists of the sole in B, from those of the knee's point.
    const Eigen::Matrix3d& R = posture.X_WB.linear();
    Matrix6d of_sole = Matrix6d::Zero();
    of_sole.topLeftCorner<3, 3>() = of_sole.bottomRightCorner<3, 3>() = R.transpose();
    of_sole.bottomLeftCorner<3, 3>() =
        -R.transpose() * CrossMatrix(posture.X_WSole[0].translation() - leg.points[3]);
    posture.jacobian_inverse[0] = Y * of_sole.inverse();
    const KneeMatch knee(motion, Side::kLeft);
    std::array<double, 6> angles;
    const double far = draw.Uniform(0, 1) < 0.1 ? 1.0 : 0.1;
    for (size_t link = 0; link < 6; ++link) {
      angles[link] = draw.Sparse(far);
      turned[link] = draw.Turn(angles[link]);
    }
    const Matrix6d there = leg.Jacobian(turned).inverse();
    const Eigen::Index row = static_cast<Eigen::Index>(draw.Uniform(0, 6));
    Vector6d along;
    along << Vector3d(Y.row(row).head<3>()).normalized(),
        Vector3d(Y.row(row).tail<3>()).normalized();
    VectorBall turn = draw.Ball(3), velocity = draw.Ball(3);
    const double sign = draw.Uniform(0, 1) < 0.5 ? -1 : 1;
    const Vector6d off =
        sign * Spatial(turn.radius * along.head<3>(), velocity.radius * along.tail<3>());
    const auto all = knee.Solve(turn, velocity, angles);
    none += !all;
    if (all) {
      const Vector6d x = there * (Spatial(turn.center, velocity.center) + off);
      for (Eigen::Index k = 0; k < 6; ++k) {
        solved.Compare(std::abs(x[k] - all->center[k]), all->radius[k], x.norm());
      }
    }
    const Vector6d x = (there * off).cwiseAbs();
    const Vector6d less =
        knee.Lowered(draw.Uniform(1, 3) * x, turn.radius, velocity.radius, angles);
    for (Eigen::Index k = 0; k < 6; ++k) lowered.Compare(x[k], less[k], x.norm());
  }
  EXPECT_GT(none, Draws(20000) / 100);
  EXPECT_LT(solved.excess, 1.0);
  EXPECT_LT(lowered.excess, 1.0);
  EXPECT_GT(solved.nearest, 0.85);  // an eighth is added to what is found
  EXPECT_GT(lowered.nearest, 0.99);
}

}  // namespace
}  // namespace halfstep
