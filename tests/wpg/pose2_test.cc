#include "wpg/geometry/pose2.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace halfstep {
namespace {

double Difference(const Pose2& a, const Pose2& b) {
  return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.yaw - b.yaw)});
}

class Pose2Test : public testing::Test {
 protected:
  Pose2 Random() { return {uniform_(random_), uniform_(random_), uniform_(random_)}; }
  Eigen::Vector2d RandomPoint() { return {uniform_(random_), uniform_(random_)}; }

 private:
  std::mt19937 random_{1};
  std::uniform_real_distribution<double> uniform_{-4, 4};
};

TEST_F(Pose2Test, QuarterTurnAheadByHand) {
  const Pose2 X_AB{1, 2, std::numbers::pi / 2};
  EXPECT_LT((X_AB * Eigen::Vector2d(3, 0) - Eigen::Vector2d(1, 5)).norm(), 1e-15);
  EXPECT_LT(Difference(X_AB * Pose2{3, 1, 0.5}, {0, 5, std::numbers::pi / 2 + 0.5}), 1e-15);
}

TEST_F(Pose2Test, ActsAsTheSpatialIsometryDoes) {
  for (int i = 0; i < 100; ++i) {
    const Pose2 a = Random(), b = Random();
    const Eigen::Vector2d p = RandomPoint();
    const Eigen::Vector3d q = ToIsometry(a, 0.3) * Eigen::Vector3d(p.x(), p.y(), 0.5);
    EXPECT_LT((q.head<2>() - a * p).norm(), 1e-14);
    EXPECT_NEAR(q.z(), 0.8, 1e-15);
    EXPECT_LT((a.rotation() * p + a.position() - a * p).norm(), 1e-14);
    const Eigen::Matrix4d product = (ToIsometry(a, 0.3) * ToIsometry(b, 0.5)).matrix();
    EXPECT_LT((ToIsometry(a * b, 0.8).matrix() - product).norm(), 1e-14);
  }
}

TEST_F(Pose2Test, InverseUndoesFromBothSides) {
  for (int i = 0; i < 100; ++i) {
    const Pose2 a = Random();
    EXPECT_LT(Difference(a * a.Inverse(), {}), 1e-14);
    EXPECT_LT(Difference(a.Inverse() * a, {}), 1e-14);
  }
}

TEST_F(Pose2Test, MirroringIsAnAutomorphismAndItsOwnInverse) {
  for (int i = 0; i < 100; ++i) {
    const Pose2 a = Random(), b = Random();
    EXPECT_EQ(a.Mirrored().Mirrored(), a);
    EXPECT_LT(Difference((a * b).Mirrored(), a.Mirrored() * b.Mirrored()), 1e-14);
  }
}

TEST_F(Pose2Test, YawKeepsItsTurns) {
  EXPECT_EQ((Pose2{0, 0, 3} * Pose2{0, 0, 4}).yaw, 7);
  EXPECT_EQ((Pose2{0, 0, 9}.Inverse().yaw), -9);
}

}  // namespace
}  // namespace halfstep
