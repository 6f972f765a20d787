#include "wpg/geometry/simplified_hull.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include "tests/draws.h"
#include "tests/wpg/random_direction.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

ConvexBody Ellipsoid(int count, const Vector3d& size, std::mt19937* random) {
  Eigen::Matrix3Xd points(3, count);
  for (auto p : points.colwise()) p = size.cwiseProduct(RandomDirection(random));
  return MakeHull(points);
}

// A box whose edges are rounded by `radius` [m].
ConvexBody RoundedBox(const Vector3d& half, double radius, int count, std::mt19937* random) {
  Eigen::Matrix3Xd points(3, count);
  for (auto p : points.colwise()) {
    const Vector3d d = RandomDirection(random);
    p = d.cwiseSign().cwiseProduct(half) + radius * d;
  }
  return MakeHull(points);
}

std::vector<ConvexBody> Bodies() {
  std::mt19937 random(1);
  std::vector<ConvexBody> bodies;
  for (const int count : {70, 200, 950}) {
    bodies.push_back(Ellipsoid(count, {0.1, 0.1, 0.1}, &random));
    bodies.push_back(Ellipsoid(count, {0.05, 0.08, 0.3}, &random));
    bodies.push_back(RoundedBox({0.1, 0.05, 0.02}, 0.004, count, &random));
    ConvexBody far = Ellipsoid(count, {0.1, 0.2, 0.1}, &random);
    far.vertices.colwise() += Vector3d(3, -2, 1);
    bodies.push_back(MakeHull(far.vertices));
  }
  return bodies;
}

TEST(SimplifiedHull, ContainsTheHullAndNoPointIsFartherFromItThanTheExcess) {
  std::mt19937 random(2);
  for (const ConvexBody& hull : Bodies()) {
    for (const int vertices : {24, 64}) {
      const SimplifiedHull simple = SimplifyOutward(hull, vertices);
      ASSERT_LE(simple.body.vertices.cols(), vertices);
      EXPECT_GT(simple.excess, 0.0);
      EXPECT_LT(simple.excess, 0.2 * hull.radius);
      double most = 0;
      for (int i = 0; i < Draws(3000); ++i) {
        const Vector3d d = RandomDirection(&random);
        const double more = Support(simple.body, d) - Support(hull, d);
        ASSERT_GE(more, -1e-15 * (1 + hull.center.norm()));
        ASSERT_LE(more, simple.excess + 1e-15 * (1 + hull.center.norm()));
        most = std::max(most, more);
      }
      EXPECT_GT(most, 0.3 * simple.excess) << "far more excess is stated than there is";
    }
  }
}

TEST(SimplifiedHull, ReachesNoFartherAlongKeptDirections) {
  std::mt19937 random(3);
  for (const ConvexBody& hull : Bodies()) {
    const Eigen::Matrix3d R =
        Eigen::Quaterniond::FromTwoVectors(RandomDirection(&random), Vector3d::UnitZ()).matrix();
    Eigen::Matrix3Xd kept(3, 6);
    kept << R, -R;
    const SimplifiedHull simple = SimplifyOutward(hull, 64, kept);
    ASSERT_LT(simple.body.vertices.cols(), hull.vertices.cols());
    for (const Vector3d& d : kept.colwise()) {
      EXPECT_NEAR(Support(simple.body, d), Support(hull, d), 1e-13);
    }
    for (int i = 0; i < Draws(1000); ++i) {
      const Vector3d d = RandomDirection(&random);
      EXPECT_GE(Support(simple.body, d), Support(hull, d) - 1e-14);
    }
  }
}

TEST(SimplifiedHull, ABoxWithRoundedEdgesKeepsItsFaces) {
  std::mt19937 random(4);
  const ConvexBody hull = RoundedBox({0.1, 0.05, 0.02}, 0.004, 2000, &random);
  EXPECT_LT(SimplifyOutward(hull, 64).excess, 0.001);
}

TEST(SimplifiedHull, AHullWithFewVerticesStaysAsItIs) {
  std::mt19937 random(5);
  const ConvexBody hull = Ellipsoid(64, {0.1, 0.1, 0.2}, &random);
  const SimplifiedHull same = SimplifyOutward(hull, 64);
  EXPECT_EQ(same.body.vertices, hull.vertices);
  EXPECT_EQ(same.body.ball_radius, hull.ball_radius);
  EXPECT_EQ(same.excess, 0.0);
}

TEST(SimplifiedHull, RefusesWhatItCannotTake) {
  std::mt19937 random(6);
  const ConvexBody hull = Ellipsoid(100, {0.1, 0.1, 0.2}, &random);
  EXPECT_THROW(SimplifyOutward(hull, 23), std::logic_error);
  EXPECT_THROW(SimplifyOutward(MakeCylinder(1, 1), 64), std::logic_error);
}

}  // namespace
}  // namespace halfstep
