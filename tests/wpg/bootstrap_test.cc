#include "wpg/robot/bootstrap.h"

#include <gtest/gtest.h>

namespace halfstep {
namespace {

using Eigen::Vector2d;

// Rates that are a + B v of what bounds them: all v ≤ v(m) + h (a + B v) are below the solution of
// the equation, which is there where h B has a spectral radius below 1.
struct Growth {
  Vector2d at_m, a;
  Eigen::Matrix2d B;

  std::optional<Vector2d> Bound(double h) const {
    return Bootstrap<Vector2d>(
        at_m, h, [&](const Vector2d& v) { return std::optional<Vector2d>(a + B * v); });
  }
  Vector2d Largest(double h) const {
    return (Eigen::Matrix2d::Identity() - h * B).inverse() * (at_m + h * a);
  }
};

TEST(Bootstrap, HoldsAllThatCanGrow) {
  const Growth growths[] = {{{1, 0}, {0, 0}, Eigen::Matrix2d{{1, 0}, {0, 1}}},
                            {{1, 2}, {3, 0}, Eigen::Matrix2d{{0, 1}, {1, 0}}},
                            {{0, 0}, {1, 1}, Eigen::Matrix2d{{0.5, 0}, {1, 0.5}}},
                            {{1, 1}, {0, 0}, Eigen::Matrix2d{{0, 0}, {0, 1}}}};
  for (const Growth& growth : growths) {
    for (const double h : {0.01, 0.1, 0.3, 0.5}) {
      const auto bound = growth.Bound(h);
      ASSERT_TRUE(bound) << h;
      EXPECT_GE((*bound - growth.Largest(h)).minCoeff(), -1e-12) << h;
    }
    const Vector2d little = *growth.Bound(1e-3);
    EXPECT_LT((little - growth.Largest(1e-3)).maxCoeff(), 1e-5);
  }
}

TEST(Bootstrap, IsNotThereWhereOneOfThemGrowsBeyondAll) {
  const Growth growth{{1, 1}, {0, 0}, Eigen::Matrix2d{{0, 0}, {0, 1}}};
  EXPECT_FALSE(growth.Bound(1.0));
  EXPECT_FALSE(growth.Bound(1.5));
}

TEST(Bootstrap, IsNotThereWithoutRates) {
  int asked = 0;
  EXPECT_FALSE(Bootstrap<Vector2d>({1, 1}, 0.1, [&](const Vector2d&) -> std::optional<Vector2d> {
    ++asked;
    return std::nullopt;
  }));
  EXPECT_EQ(asked, 1);
}

}  // namespace
}  // namespace halfstep
