#include "wpg/ground/ground.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace halfstep {
namespace {

constexpr double kAnywhere = std::numeric_limits<double>::infinity();

TEST(FlatGround, IsOneLevelEverywhere) {
  Eigen::Matrix2Xd outline(2, 3);
  outline << 0.1, -0.1, -0.1, 0.0, 0.1, -0.1;
  for (const double height : {0.0, -0.3, 0.15}) {
    const FlatGround flat(height);
    const Ground& ground = flat;
    EXPECT_EQ(ground.Floor(), height);
    EXPECT_TRUE(ground.Solids().empty());
    ASSERT_EQ(ground.Levels().size(), 1u);
    EXPECT_EQ(ground.OnlyLevel(), ground.Levels().front());
    EXPECT_EQ(ground.HeightEverywhere(), height);
    for (const Pose2& X_WF : {Pose2{}, Pose2{1e3, -1e3, 7.0}}) {
      const std::optional<GroundLevel> level = ground.LevelUnder(outline, X_WF, kAnywhere);
      ASSERT_TRUE(level.has_value());
      EXPECT_EQ(*level, (GroundLevel{.number = 0, .height = height}));
      EXPECT_EQ(ground.LevelUnder(outline, X_WF, height), level);
      EXPECT_EQ(ground.LevelUnder(outline, X_WF, height - 1e-3), std::nullopt);
      EXPECT_EQ(ground.Standing(outline, X_WF), Foothold(X_WF, height));
      EXPECT_EQ(ground.Standing(outline, X_WF, height - 1e-3), std::nullopt);
    }
  }
  EXPECT_EQ(FlatGround().Floor(), 0.0);
  EXPECT_NO_THROW(FlatGround().CheckIsZeroEverywhere());
  EXPECT_THROW(FlatGround(0.1).CheckIsZeroEverywhere(), std::logic_error);
  EXPECT_THROW(FlatGround{kAnywhere}, std::logic_error);
}

}  // namespace
}  // namespace halfstep
