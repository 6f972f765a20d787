#include "wpg/geometry/footprint.h"

#include <gtest/gtest.h>

namespace halfstep {
namespace {

TEST(Footprint, ComposesAsAPlanarPoseAndItsHeightsAdd) {
  const Footprint X_AB(0.3, -0.1, 0.7, 0.2), X_BC(0.2, 0.25, -0.3, -0.05);
  const Footprint X_AC = X_AB * X_BC;
  const Pose2 planar = static_cast<const Pose2&>(X_AB) * static_cast<const Pose2&>(X_BC);
  EXPECT_EQ(static_cast<const Pose2&>(X_AC), planar);
  EXPECT_DOUBLE_EQ(X_AC.height, 0.15);
  const Footprint back = X_AC * X_BC.Inverse();
  EXPECT_NEAR(back.x, X_AB.x, 1e-15);
  EXPECT_NEAR(back.y, X_AB.y, 1e-15);
  EXPECT_NEAR(back.yaw, X_AB.yaw, 1e-15);
  EXPECT_NEAR(back.height, X_AB.height, 1e-15);
  EXPECT_EQ(X_AB.Mirrored().Mirrored(), X_AB);
  EXPECT_EQ(X_AB.Mirrored().height, X_AB.height);
}

TEST(Footprint, APlanarPoseIsAPlaceOnTheFloor) {
  const Pose2 pose{0.1, 0.2, 0.3};
  EXPECT_EQ(Footprint(pose), Footprint(0.1, 0.2, 0.3));
  EXPECT_TRUE(Footprint(pose) == pose);
  EXPECT_FALSE(Footprint(0.1, 0.2, 0.3, 0.01) == pose);
}

}  // namespace
}  // namespace halfstep
