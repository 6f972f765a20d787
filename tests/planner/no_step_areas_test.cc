#include "planner/scene/no_step_areas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/draws.h"
#include "wpg/geometry/simple_polygon.h"

namespace halfstep {
namespace {

using Eigen::Matrix2Xd;
using Eigen::Vector2d;

Matrix2Xd Square(double x, double y, double half) {
  Matrix2Xd square(2, 4);
  square << x + half, x - half, x - half, x + half, y + half, y + half, y - half, y - half;
  return square;
}

// A star around a point: simple, not convex.
Matrix2Xd DrawStar(std::mt19937* random, const Vector2d& center) {
  std::uniform_real_distribution<double> radius(0.02, 0.4);
  Matrix2Xd star(2, 9);
  for (int i = 0; i < 9; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 9.0;
    star.col(i) = center + radius(*random) * Vector2d(std::cos(angle), std::sin(angle));
  }
  return star;
}

std::vector<Vector2d> PointsOfBoundary(const Matrix2Xd& polygon, int count) {
  std::vector<Vector2d> points;
  for (Eigen::Index i = 0; i < polygon.cols(); ++i) {
    const Vector2d a = polygon.col(i), b = polygon.col((i + 1) % polygon.cols());
    for (int k = 0; k < count; ++k) points.push_back(a + (b - a) * k / count);
  }
  return points;
}

TEST(PolygonDistance, IsThatOfTheNearestPointsOfTheBoundaries) {
  std::mt19937 random(401);
  std::uniform_real_distribution<double> place(-0.8, 0.8);
  int apart = 0, touching = 0;
  for (int i = 0; i < Draws(200); ++i) {
    const Matrix2Xd a = DrawStar(&random, {0, 0});
    const Matrix2Xd b = DrawStar(&random, {place(random), place(random)});
    const double distance = PolygonDistance(a, b);
    EXPECT_EQ(distance < 0.0, PolygonsTouch(a, b));
    EXPECT_NEAR(PolygonDistance(b, a), distance, 1e-15);
    if (distance < 0.0) {
      ++touching;
      continue;
    }
    ++apart;
    constexpr int kPoints = 40;
    double least = 1e9;
    for (const Vector2d& p : PointsOfBoundary(a, kPoints)) {
      for (const Vector2d& q : PointsOfBoundary(b, kPoints)) {
        least = std::min(least, (p - q).norm());
      }
    }
    EXPECT_LE(distance, least);
    EXPECT_GE(distance, least - 0.8 / kPoints);
  }
  EXPECT_GT(apart, Draws(50));
  EXPECT_GT(touching, Draws(50));
}

TEST(PolygonDistance, OfPolygonsThatShareAPointIsMinusTheDepth) {
  EXPECT_NEAR(PolygonDistance(Square(0, 0, 1), Square(1.75, 0.5, 1)), -0.25, 1e-12);
  EXPECT_NEAR(PolygonDistance(Square(0, 0, 1), Square(0.2, 0, 0.1)), -0.9, 1e-12);
  EXPECT_EQ(PolygonDistance(Square(0, 0, 1), Square(2, 0, 1)), -1e-9);  // an edge only
  EXPECT_EQ(PolygonDistance(Square(0, 0, 1), Square(2, 2, 1)), -1e-9);  // a corner only
  // Bars that cross: no corner of one is in the other.
  Matrix2Xd lying(2, 4), upright(2, 4);
  lying << 1, -1, -1, 1, 0.1, 0.1, -0.1, -0.1;
  upright << 0.1, -0.1, -0.1, 0.1, 1, 1, -1, -1;
  EXPECT_EQ(PolygonDistance(lying, upright), -1e-9);
}

TEST(NoStepAreas, NearestIsThatOfAllAreasAndClearsAgrees) {
  std::mt19937 random(402);
  std::uniform_real_distribution<double> place(-2.0, 2.0), turn(-7.0, 7.0), demand(0.0, 0.3);
  Matrix2Xd outline(2, 5);
  outline << 0.14, -0.1, -0.12, -0.1, 0.1, 0.0, 0.06, 0.0, -0.07, -0.08;
  Scene scene;
  for (int i = 0; i < 12; ++i) {
    scene.no_step.push_back(DrawStar(&random, {place(random), place(random)}));
  }
  const NoStepAreas areas(scene, outline);
  int on = 0, beside = 0;
  for (int i = 0; i < 300; ++i) {
    const Pose2 X_WF{place(random), place(random), turn(random)};
    const Matrix2Xd sole = (X_WF.rotation() * outline).colwise() + X_WF.position();
    double least = std::numeric_limits<double>::infinity();
    size_t nearest = 0;
    for (size_t a = 0; a < scene.no_step.size(); ++a) {
      const double distance = PolygonDistance(sole, scene.no_step[a]);
      if (distance < least) nearest = a;
      least = std::min(least, distance);
    }
    const NoStepAreas::Nearest found = areas.NearestTo(X_WF);
    EXPECT_EQ(found.distance, least);
    EXPECT_EQ(found.area, static_cast<int>(nearest));
    EXPECT_EQ(areas.Clears(X_WF, 0.0), least > 0.0);
    const double demanded = demand(random);
    EXPECT_EQ(areas.Clears(X_WF, demanded), least >= demanded);
    ++(least < 0.0 ? on : beside);
  }
  EXPECT_GT(on, 30);
  EXPECT_GT(beside, 30);
  EXPECT_TRUE(NoStepAreas(Scene{}, outline).Clears({}, 0.5));
  EXPECT_EQ(NoStepAreas(Scene{}, outline).NearestTo({}).area, -1);
}

}  // namespace
}  // namespace halfstep
