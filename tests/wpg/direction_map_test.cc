#include "wpg/geometry/direction_map.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "tests/draws.h"
#include "tests/wpg/random_direction.h"
#include "wpg/geometry/convex_body.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

// What tries a map: smooth bodies, long ones, rims whose points are equally far, points of planes
// and lines beside the extreme ones, and all of it far from the origin.
std::vector<ConvexBody> Bodies() {
  std::mt19937 random(1);
  std::vector<ConvexBody> bodies;
  for (const int count : {65, 200, 900, 3000}) {
    for (const Vector3d& size : {Vector3d(1, 1, 1), Vector3d(0.05, 0.08, 0.3)}) {
      Eigen::Matrix3Xd points(3, count);
      for (auto p : points.colwise()) p = size.cwiseProduct(RandomDirection(&random));
      bodies.push_back(MakeHull(points));
    }
  }
  ConvexBody rims;
  rims.vertices.resize(3, 512);
  for (int i = 0; i < 512; ++i) {
    const double angle = 2 * std::acos(-1.0) * (i / 2) / 256;
    rims.vertices.col(i) << 0.05 * std::cos(angle), 0.05 * std::sin(angle), i % 2 == 0 ? 0.2 : -0.2;
  }
  bodies.push_back(rims);
  ConvexBody lattice;
  lattice.vertices.resize(3, 125);
  for (int i = 0; i < 125; ++i) lattice.vertices.col(i) << i % 5, i / 5 % 5, i / 25;
  bodies.push_back(lattice);
  for (size_t i = 0, n = bodies.size(); i < n; ++i) {
    ConvexBody far = bodies[i];
    far.vertices.colwise() += Vector3d(70, -50, 30);
    bodies.push_back(far);
  }
  return bodies;
}

std::vector<Vector3d> Directions(const ConvexBody& body) {
  std::mt19937 random(2);
  std::vector<Vector3d> directions;
  for (int i = 0; i < Draws(2000); ++i) directions.push_back(RandomDirection(&random));
  for (int i = 0; i < 17 * 17; ++i) {  // borders and corners of squares
    const double a = (i % 17 - 8) / 8.0, b = (i / 17 - 8) / 8.0;
    for (const double sign : {1.0, -1.0}) {
      directions.insert(directions.end(), {{sign, a, b}, {b, sign, a}, {a, b, sign}});
    }
  }
  for (const Vector3d& n : body.normals.colwise()) directions.push_back(n);
  const size_t plain = directions.size();
  for (size_t i = 0; i < plain; i += 7) {
    directions.push_back(1e-100 * directions[i]);
    directions.push_back(1e100 * directions[i]);
    directions.push_back(1e-200 * directions[i]);  // all points are looked at
  }
  directions.emplace_back(0, 0, 0);
  return directions;
}

TEST(DirectionMap, FarthestVertexAndSupportAreThoseOfLookingAtAllToTheLastBit) {
  for (const ConvexBody& body : Bodies()) {
    ConvexBody mapped = body;
    MapDirections(&mapped);
    ASSERT_FALSE(mapped.directions.Along(Vector3d::UnitX()).empty());
    for (const Vector3d& d : Directions(body)) {
      ASSERT_EQ(FarthestVertex(mapped, d), FarthestVertex(body, d)) << d.transpose();
      ASSERT_EQ(Support(mapped, d), Support(body, d)) << d.transpose();
    }
  }
}

TEST(DirectionMap, ListsOfRoundBodiesAreShort) {
  std::mt19937 random(3);
  for (const int count : {200, 900, 20000}) {
    Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor> points(3, count);
    for (auto p : points.colwise()) p = RandomDirection(&random);
    const DirectionMap map(points);
    double looked_at = 0;
    for (int i = 0; i < 1000; ++i) {
      looked_at += static_cast<double>(map.Along(RandomDirection(&random)).size()) / 1000;
    }
    EXPECT_LT(looked_at, 16) << count;
  }
}

TEST(DirectionMap, ADirectionThatIsNoneHasNoListAndDoesNoHarm) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  ConvexBody body = Bodies().front();
  MapDirections(&body);
  EXPECT_TRUE(body.directions.Along({0, 0, 0}).empty());
  EXPECT_TRUE(body.directions.Along({kNan, kNan, kNan}).empty());
  EXPECT_TRUE(body.directions.Along({kInfinity, 0, 1}).empty());
  for (int axis = 0; axis < 3; ++axis) {
    Vector3d direction(1, -1, 1);
    direction[axis] = kNan;
    EXPECT_GE(FarthestVertex(body, direction), 0);
  }
  EXPECT_TRUE(DirectionMap().Along({1, 0, 0}).empty());
  EXPECT_THROW(DirectionMap(decltype(ConvexBody::vertices)(3, 0)), std::logic_error);
}

}  // namespace
}  // namespace halfstep
