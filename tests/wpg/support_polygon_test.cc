#include "wpg/geometry/support_polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "wpg/geometry/pose2.h"

namespace halfstep {
namespace {

using Eigen::Vector2d;

const Vector2d kSole(0.2172, 0.137);

double Cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// The least over all directions of how far the points reach beyond p: what a convex hull's margin
// is, found without a hull. A hull's edge is the line through two of its points.
double BruteForceMargin(const std::vector<Vector2d>& points, const Vector2d& p) {
  double margin = std::numeric_limits<double>::infinity();
  for (const Vector2d& a : points) {
    for (const Vector2d& b : points) {
      if ((b - a).norm() < 1e-9) continue;
      const Vector2d normal = Vector2d(b.y() - a.y(), a.x() - b.x()).normalized();
      double reach = -std::numeric_limits<double>::infinity();
      for (const Vector2d& q : points) reach = std::max(reach, normal.dot(q - a));
      if (reach < 1e-12) margin = std::min(margin, normal.dot(a - p));
    }
  }
  return margin;
}

double DistanceToSegment(const Vector2d& a, const Vector2d& b, const Vector2d& p) {
  const double s = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (a + s * (b - a) - p).norm();
}

double DistanceToBoundary(const SupportPolygon& polygon, const Vector2d& p) {
  double distance = std::numeric_limits<double>::infinity();
  for (int i = 0; i < polygon.size(); ++i) {
    const Vector2d a = polygon.corner(i), b = polygon.corner((i + 1) % polygon.size());
    distance = std::min(distance, DistanceToSegment(a, b, p));
  }
  return distance;
}

class SupportPolygonTest : public testing::Test {
 protected:
  double Uniform(double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(random_);
  }
  Pose2 Pose(double reach) {
    const double x = Uniform(-reach, reach), y = Uniform(-reach, reach);
    return {x, y, Uniform(-3, 3)};
  }
  static std::vector<Vector2d> Corners(const std::vector<Pose2>& soles) {
    std::vector<Vector2d> corners;
    for (const Pose2& X : soles) {
      const double x = kSole.x() / 2, y = kSole.y() / 2;
      for (const Vector2d& c : {Vector2d(x, y), Vector2d(-x, y), Vector2d(-x, -y), Vector2d(x, -y)})
        corners.push_back(X * c);
    }
    return corners;
  }
  // Against brute force at random points; inside, the distance to the boundary; outside, no less
  // than minus it.
  void CheckMargins(const SupportPolygon& polygon, const std::vector<Vector2d>& corners) {
    for (int i = 0; i < 20; ++i) {
      const Vector2d p = corners[0] + Vector2d(Uniform(-0.4, 0.4), Uniform(-0.4, 0.4));
      const double margin = polygon.Margin(p);
      EXPECT_NEAR(margin, BruteForceMargin(corners, p), 1e-12);
      if (margin >= 0) {
        EXPECT_NEAR(margin, DistanceToBoundary(polygon, p), 1e-12);
      } else {
        EXPECT_GE(margin, -DistanceToBoundary(polygon, p) - 1e-12);
      }
    }
  }

 private:
  std::mt19937 random_{2};
};

TEST_F(SupportPolygonTest, OneSoleByHand) {
  const SupportPolygon polygon({1, 2, 0}, {0.2, 0.1});
  EXPECT_EQ(polygon.size(), 4);
  EXPECT_NEAR(polygon.Margin({1, 2}), 0.05, 1e-15);
  EXPECT_NEAR(polygon.Margin({1.08, 2}), 0.02, 1e-15);
  EXPECT_NEAR(polygon.Margin({1, 1.96}), 0.01, 1e-15);
  EXPECT_NEAR(polygon.Margin({1.1, 2}), 0.0, 1e-15);
  EXPECT_NEAR(polygon.Margin({1.13, 2}), -0.03, 1e-15);
  EXPECT_NEAR(polygon.Margin({1, 2.06}), -0.01, 1e-15);
}

TEST_F(SupportPolygonTest, FeetSideBySideByHand) {
  const SupportPolygon polygon({0, 0.1, 0}, {0, -0.1, 0}, {0.2, 0.1});
  EXPECT_NEAR(polygon.Margin({0, 0}), 0.1, 1e-15);
  EXPECT_NEAR(polygon.Margin({0, 0.12}), 0.03, 1e-15);
  EXPECT_NEAR(polygon.Margin({0.07, -0.1}), 0.03, 1e-15);
  EXPECT_NEAR(polygon.Margin({0, 0.16}), -0.01, 1e-15);
}

TEST_F(SupportPolygonTest, OneSoleAgainstBruteForce) {
  for (int i = 0; i < 200; ++i) {
    const Pose2 X_WS = Pose(2);
    CheckMargins(SupportPolygon(X_WS, kSole), Corners({X_WS}));
  }
}

TEST_F(SupportPolygonTest, TwoSolesAgainstBruteForce) {
  for (int i = 0; i < 200; ++i) {
    const Pose2 X_WL = Pose(1), X_LR = Pose(0.3);
    const SupportPolygon polygon(X_WL, X_WL * X_LR, kSole);
    CheckMargins(polygon, Corners({X_WL, X_WL * X_LR}));
    for (int k = 0; k < polygon.size(); ++k) {  // counter-clockwise and convex
      const Vector2d a = polygon.corner(k), b = polygon.corner((k + 1) % polygon.size());
      const Vector2d c = polygon.corner((k + 2) % polygon.size());
      EXPECT_GT(Cross(b - a, c - b), 0.0);
    }
  }
}

TEST_F(SupportPolygonTest, AlignedSolesAtAnyYawAgainstBruteForce) {
  // Four corners on one line, but for rounding, and soles at the same place.
  for (int i = 0; i < 200; ++i) {
    const Pose2 X_WL = Pose(1);
    for (const Pose2& X_LR :
         {Pose2{0, -0.2, 0}, Pose2{0.3, 0, 0}, Pose2{0, 0, 0}, Pose2{0, 0, 0.5 * M_PI * (i % 4)}}) {
      const std::vector<Pose2> soles = {X_WL, X_WL * X_LR};
      CheckMargins(SupportPolygon(soles[0], soles[1], kSole), Corners(soles));
    }
  }
}

TEST_F(SupportPolygonTest, TwoSolesHoldAllThatEitherHolds) {
  for (int i = 0; i < 1000; ++i) {
    const Pose2 X_WL = Pose(0.3), X_WR = Pose(0.3);
    const Vector2d p(Uniform(-0.4, 0.4), Uniform(-0.4, 0.4));
    const double both = SupportPolygon(X_WL, X_WR, kSole).Margin(p);
    EXPECT_EQ(both, SupportPolygon(X_WL, X_WR, kSole).Margin(p));
    EXPECT_NEAR(both, SupportPolygon(X_WR, X_WL, kSole).Margin(p), 1e-14);
    for (const Pose2& X : {X_WL, X_WR}) {
      const double one = SupportPolygon(X, kSole).Margin(p);
      if (one > 0) {
        EXPECT_GE(both, one - 1e-14);
      }
    }
  }
}

}  // namespace
}  // namespace halfstep
