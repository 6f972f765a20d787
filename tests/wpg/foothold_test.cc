#include "wpg/geometry/foothold.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <type_traits>

#include "wpg/motion/walk_state.h"

namespace halfstep {
namespace {

static_assert(!std::is_convertible_v<Foothold, Pose2> && !std::is_convertible_v<Pose2, Foothold>,
              "a height is neither left out nor made up unasked");

TEST(Foothold, ComposesAsAPlanarPoseAndItsHeightsAdd) {
  const Foothold X_AB({0.3, -0.1, 0.7}, 0.2), X_BC({0.2, 0.25, -0.3}, -0.05);
  const Foothold X_AC = X_AB * X_BC;
  EXPECT_EQ(X_AC.Planar(), X_AB.Planar() * X_BC.Planar());
  EXPECT_DOUBLE_EQ(X_AC.height, 0.15);
  const Foothold back = X_AC * X_BC.Inverse();
  EXPECT_NEAR(back.x, X_AB.x, 1e-15);
  EXPECT_NEAR(back.y, X_AB.y, 1e-15);
  EXPECT_NEAR(back.yaw, X_AB.yaw, 1e-15);
  EXPECT_NEAR(back.height, X_AB.height, 1e-15);
  EXPECT_EQ(X_AB.Mirrored().Mirrored(), X_AB);
  EXPECT_EQ(X_AB.Mirrored().height, X_AB.height);
  EXPECT_TRUE(ToIsometry(X_AC).isApprox(ToIsometry(X_AB) * ToIsometry(X_BC), 1e-15));
}

TEST(Foothold, OnlyALevelOneIsAPoseOfItsLevel) {
  const Pose2 pose{0.1, 0.2, 0.3};
  EXPECT_EQ(Foothold::Level(pose).LevelPose(), pose);
  EXPECT_EQ(Foothold::Level(pose), Foothold(pose, 0.0));
  EXPECT_NE(Foothold::Level(pose), Foothold(pose, 0.01));
  EXPECT_EQ(Foothold(pose, 0.01).Planar(), pose);
  EXPECT_THROW((void)Foothold(pose, 0.01).LevelPose(), std::logic_error);
  EXPECT_THROW((void)Foothold(pose, -0.01).LevelPose(), std::logic_error);
}

TEST(Foothold, RaisesTheFeetAndTheWaistOfAState) {
  WalkState x_S = WalkState::LinSpaced(0.1, 1.3);
  const Foothold X_AS({0.3, -0.1, 0.7}, 0.2);
  WalkState x_A = Transformed(Foothold::Level(X_AS.Planar()), x_S);
  x_A[kLeftZ] += 0.2;
  x_A[kRightZ] += 0.2;
  x_A[kWaistZ] += 0.2;
  EXPECT_EQ(Transformed(X_AS, x_S), x_A);
}

}  // namespace
}  // namespace halfstep
