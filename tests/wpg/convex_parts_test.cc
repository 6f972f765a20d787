#include "wpg/geometry/convex_parts.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "tests/draws.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

struct Surface {
  Eigen::Matrix3Xd vertices;
  Eigen::Matrix3Xi triangles;
};

// How far a point is outside of the nearest of some bodies, at least; ≤ 0 when it is in one [m].
double Outside(const std::vector<ConvexBody>& parts, const Vector3d& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const ConvexBody& part : parts) {
    double most = -std::numeric_limits<double>::infinity();
    for (const auto& normal : part.normals.colwise()) {
      most = std::max(most, normal.dot(point) - Support(part, normal));
    }
    least = std::min(least, most);
  }
  return least;
}

double VolumeOfAll(const std::vector<ConvexBody>& parts) {
  double volume = 0.0;
  for (const ConvexBody& part : parts) {
    for (const Eigen::Vector3i& face : part.triangles) {
      const Vector3d a = part.vertices.col(face[0]) - part.center;
      const Vector3d b = part.vertices.col(face[1]) - part.center;
      const Vector3d c = part.vertices.col(face[2]) - part.center;
      volume += a.dot(b.cross(c)) / 6;
    }
  }
  return volume;
}

// A surface around the origin, its distance from there along each direction a wavy function.
double WavyRadius(const Vector3d& d) {
  return 0.1 * (1.0 + 0.3 * std::sin(5 * d.x()) * std::cos(4 * d.y()) + 0.4 * d.z() * d.z());
}

Surface Wavy(int rings, int sides) {
  Surface s;
  s.vertices.resize(3, (rings + 1) * sides);
  s.triangles.resize(3, 2 * rings * sides);
  Eigen::Index n = 0;
  for (int i = 0; i <= rings; ++i) {
    for (int k = 0; k < sides; ++k) {
      const double polar = std::numbers::pi * i / rings, around = 2 * std::numbers::pi * k / sides;
      const Vector3d d(std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around),
                       std::cos(polar));
      s.vertices.col(i * sides + k) = WavyRadius(d) * d;
      if (i == rings) continue;
      const int a = i * sides + k, b = i * sides + (k + 1) % sides;
      s.triangles.col(n++) << a, b, a + sides;
      s.triangles.col(n++) << b, b + sides, a + sides;
    }
  }
  return s;
}

// An L of two boxes, 1 x 1 x 0.25 m and 0.25 x 1 x 0.75 m on it.
Surface Angle() {
  const double x[6] = {0, 1, 1, 0.25, 0.25, 0}, z[6] = {0, 0, 0.25, 0.25, 1, 1};
  Surface s;
  s.vertices.resize(3, 12);
  for (int i = 0; i < 6; ++i) {
    s.vertices.col(i) << x[i], 0, z[i];
    s.vertices.col(i + 6) << x[i], 1, z[i];
  }
  s.triangles.resize(3, 20);
  Eigen::Index n = 0;
  for (int i = 0; i < 6; ++i) {
    const int next = (i + 1) % 6;
    s.triangles.col(n++) << i, next, i + 6;
    s.triangles.col(n++) << next, next + 6, i + 6;
  }
  for (const int side : {0, 6}) {
    for (const auto& face : {std::array{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}) {
      s.triangles.col(n++) << side + face[0], side + face[1], side + face[2];
    }
  }
  return s;
}

TEST(ConvexParts, ContainWhatTheMeshEncloses) {
  const Surface s = Wavy(12, 16);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (const int count : {2, 5, 12}) {
    const std::vector<ConvexBody> parts = CutIntoConvexParts(s.vertices, s.triangles, count);
    ASSERT_GT(parts.size(), 1u);
    ASSERT_LE(static_cast<int>(parts.size()), count);
    double farthest_in = 0.0;
    for (int i = 0; i < Draws(5000); ++i) {
      // In the tetrahedron of a triangle and the origin, which sees all of the surface.
      const auto triangle = s.triangles.col(
          static_cast<Eigen::Index>(random() % static_cast<unsigned>(s.triangles.cols())));
      Eigen::Array3d weights(share(random), share(random), share(random));
      weights /= weights.sum();
      Vector3d point = Vector3d::Zero();
      for (int k = 0; k < 3; ++k) point += weights[k] * s.vertices.col(triangle[k]);
      if (i % 2 == 0) point *= share(random);
      ASSERT_LE(Outside(parts, point), 1e-15) << count << ": " << point.transpose();
      farthest_in = std::max(farthest_in, -Outside(parts, point));
    }
    EXPECT_GT(farthest_in, 0.01);
  }
}

TEST(ConvexParts, AnAngleIsTwoBoxes) {
  const Surface s = Angle();
  const std::vector<ConvexBody> whole = CutIntoConvexParts(s.vertices, s.triangles, 1);
  ASSERT_EQ(whole.size(), 1u);
  EXPECT_EQ(whole[0].vertices, MakeHull(s.vertices).vertices);
  EXPECT_EQ(whole[0].ball_radius, MakeHull(s.vertices).ball_radius);
  const std::vector<ConvexBody> parts = CutIntoConvexParts(s.vertices, s.triangles, 8);
  EXPECT_EQ(parts.size(), 2u) << "no further cut saves anything";
  EXPECT_NEAR(VolumeOfAll(parts), 0.25 + 0.25 * 0.75, 1e-9);
  EXPECT_GT(Outside(parts, {0.6, 0.5, 0.6}), 0.3) << "what one hull fills";
  EXPECT_LT(Outside(whole, {0.6, 0.5, 0.6}), 0.0);
}

TEST(ConvexParts, AnOpenMeshIsContained) {
  Surface s = Wavy(8, 10);
  s.triangles.conservativeResize(3, s.triangles.cols() / 2);  // its upper half, without a bottom
  const std::vector<ConvexBody> parts = CutIntoConvexParts(s.vertices, s.triangles, 6);
  for (const auto& triangle : s.triangles.colwise()) {
    const Vector3d middle =
        (s.vertices.col(triangle[0]) + s.vertices.col(triangle[1]) + s.vertices.col(triangle[2])) /
        3;
    EXPECT_LE(Outside(parts, middle), 1e-15);
  }
}

TEST(ConvexParts, WhatHasNoHullIsRefused) {
  Surface s = Angle();
  EXPECT_THROW(CutIntoConvexParts(s.vertices, s.triangles, 0), std::logic_error);
  s.vertices.row(1).setZero();
  EXPECT_THROW(CutIntoConvexParts(s.vertices, s.triangles, 4), std::runtime_error);
}

}  // namespace
}  // namespace halfstep
