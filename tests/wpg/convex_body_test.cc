#include "wpg/geometry/convex_body.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>

#include "tests/refusal_of.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

Vector3d RandomPoint(std::mt19937* random) {
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const double x = coordinate(*random), y = coordinate(*random), z = coordinate(*random);
  return {x, y, z};
}

Eigen::Matrix3Xd RandomPoints(int count, std::mt19937* random) {
  Eigen::Matrix3Xd points(3, count);
  for (int i = 0; i < count; ++i) points.col(i) = RandomPoint(random);
  return points;
}

TEST(ConvexBody, SupportOfPrimitivesIsTheClosedForm) {
  std::mt19937 random(1);
  const ConvexBody box = MakeBox({0.2, 0.4, 0.6}), sphere = MakeSphere(0.3);
  const ConvexBody cylinder = MakeCylinder(0.2, 0.5), capsule = MakeCapsule(0.2, 0.5);
  for (int i = 0; i < 1000; ++i) {
    const Vector3d d = RandomPoint(&random).normalized();
    EXPECT_NEAR(Support(box, d), d.cwiseAbs().dot(Vector3d(0.1, 0.2, 0.3)), 1e-15);
    EXPECT_NEAR(Support(sphere, d), 0.3, 1e-15);
    EXPECT_NEAR(Support(cylinder, d), 0.2 * d.head<2>().norm() + 0.25 * std::abs(d.z()), 1e-15);
    EXPECT_NEAR(Support(capsule, d), 0.2 + 0.25 * std::abs(d.z()), 1e-15);
    for (const ConvexBody& body : {box, sphere, cylinder, capsule}) {
      EXPECT_NEAR(SupportPoint(body, d).dot(d), Support(body, d), 1e-14);
    }
  }
}

TEST(ConvexBody, SupportIsTheLargestOverSampledPointsOfTheSum) {
  std::mt19937 random(2);
  ConvexBody body = MakeHull(RandomPoints(12, &random));
  body.disc_radius = 0.3;
  body.ball_radius = 0.1;
  BoundBySphere(&body);
  std::uniform_real_distribution<double> angle(-std::numbers::pi, std::numbers::pi);
  std::vector<Vector3d> samples;
  for (int i = 0; i < 20000; ++i) {
    const double phi = angle(random);
    const Vector3d disc(0.3 * std::cos(phi), 0.3 * std::sin(phi), 0);
    samples.push_back(body.vertices.col(i % body.vertices.cols()) + disc +
                      0.1 * RandomPoint(&random).normalized());
    EXPECT_LE((samples.back() - body.center).norm(), body.radius);
  }
  for (int i = 0; i < 50; ++i) {
    const Vector3d d = RandomPoint(&random).normalized();
    double largest = -10;
    for (const Vector3d& sample : samples) largest = std::max(largest, sample.dot(d));
    EXPECT_LE(largest, Support(body, d) + 1e-12);
    EXPECT_GE(largest, Support(body, d) - 0.02);
  }
}

TEST(ConvexBody, BoundingSphereOfPrimitivesIsTheSmallest) {
  EXPECT_NEAR(MakeBox({2, 4, 4}).radius, 3, 1e-9);
  EXPECT_NEAR(MakeSphere(0.3).radius, 0.3, 1e-9);
  EXPECT_NEAR(MakeCylinder(0.3, 0.8).radius, 0.5, 1e-9);
  EXPECT_NEAR(MakeCapsule(0.3, 0.8).radius, 0.7, 1e-9);
  EXPECT_EQ(MakeBox({2, 4, 4}).center, Vector3d::Zero());
}

TEST(ConvexBody, HullContainsItsPointsAndHasExtremePointsOnly) {
  std::mt19937 random(3);
  for (const double scale : {1e-3, 1.0, 1e3}) {
    const Vector3d offset(10, -20, 5);
    const Eigen::Matrix3Xd points = (scale * RandomPoints(300, &random)).colwise() + offset;
    const ConvexBody hull = MakeHull(points);
    ASSERT_GT(hull.normals.cols(), 10);
    for (int i = 0; i < hull.normals.cols(); ++i) {
      const Vector3d n = hull.normals.col(i);
      EXPECT_NEAR(n.norm(), 1, 1e-12);
      EXPECT_LE((n.transpose() * points).maxCoeff(), Support(hull, n) + 1e-9 * scale);
      EXPECT_GT(Support(hull, n), n.dot(hull.center));
    }
    EXPECT_LT(hull.vertices.cols(), 150);
    // Euler: a triangulated sphere has 2·V − 4 faces.
    EXPECT_EQ(static_cast<Eigen::Index>(hull.triangles.size()), 2 * hull.vertices.cols() - 4);
    for (const Vector3d& p : points.colwise()) {
      EXPECT_LE((p - hull.center).norm(), hull.radius);
    }
  }
}

TEST(ConvexBody, TrianglesAreCounterClockwiseFromOutside) {
  std::mt19937 random(4);
  for (const ConvexBody& body : {MakeBox({1, 2, 3}), MakeHull(RandomPoints(50, &random))}) {
    double volume = 0;
    for (const Eigen::Vector3i& t : body.triangles) {
      const Vector3d a = body.vertices.col(t[0]), b = body.vertices.col(t[1]);
      const Vector3d c = body.vertices.col(t[2]);
      const Vector3d normal = (b - a).cross(c - a);
      EXPECT_GT(normal.dot(a - body.center), 0);
      volume += a.dot(b.cross(c)) / 6;
    }
    EXPECT_NEAR(volume, body.vertices.cols() == 8 ? 6 : volume, 1e-12);
  }
}

TEST(ConvexBody, HullOfABoxWithFacePointsAndDuplicatesIsTheBox) {
  const ConvexBody box = MakeBox({1, 2, 3});
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(-0.5, 0.5);
  Eigen::Matrix3Xd points(3, 200);
  for (int i = 0; i < 200; ++i) {
    const double y = 2 * part(random), z = 3 * part(random);
    points.col(i) =
        i < 24 ? Vector3d(box.vertices.col(i % 8) * (1 + (i / 8) * 1e-16)) : Vector3d(0.5, y, z);
  }
  const ConvexBody hull = MakeHull(points);
  EXPECT_EQ(hull.vertices.cols(), 8);
  EXPECT_EQ(hull.normals.cols(), 6);
  EXPECT_EQ(hull.triangles.size(), 12u);
}

TEST(ConvexBody, HullOfNearAndFarPointsContainsThemAll) {
  std::mt19937 random(7);
  for (const double far : {1.0, 1e3, 1e7, 9e8, 9e14}) {
    Eigen::Matrix3Xd points(3, 45);
    points.leftCols(40) = RandomPoints(40, &random);
    points.rightCols(5) << far, far, far, 0.9 * far, 0.8 * far,  //
        0, far, -far, 0.5 * far, 0.1 * far,                      //
        0, 0.3 * far, 0.1 * far, -far, far;
    const ConvexBody hull = MakeHull(points);
    double worst = 0;
    for (int k = 0; k < 2000; ++k) {
      const Vector3d n = RandomPoints(1, &random).col(0).normalized();
      // In extended precision, so that only the hull counts.
      const auto reach = [&](const auto& of) {
        return (n.transpose().cast<long double>() * of.template cast<long double>()).maxCoeff();
      };
      const long double beyond = reach(points) - reach(hull.vertices);
      worst = std::max(worst, static_cast<double>(beyond));
      EXPECT_LE(beyond, hull.ball_radius) << far;
    }
    EXPECT_LE(hull.ball_radius, 1e-11 * far) << far << ", worst " << worst;
    if (far == 1.0) {
      EXPECT_LE(hull.ball_radius, 2e-14);
    }
    for (const Vector3d& v : hull.vertices.colwise()) {
      const auto same = [&](const auto& p) { return p == v; };
      EXPECT_TRUE(std::any_of(points.colwise().begin(), points.colwise().end(), same));
    }
  }
}

TEST(ConvexBody, HullWhoseVerticesAreAllPointsIsExact) {
  std::mt19937 random(8);
  Eigen::Matrix3Xd points = RandomPoints(40, &random);
  points.colwise().normalize();
  EXPECT_EQ(MakeHull(points).ball_radius, 0.0);
  EXPECT_EQ(MakeHull(MakeBox({1, 2, 3}).vertices).ball_radius, 0.0);
}

TEST(ConvexBody, HullOfAThinPlateIsKept) {
  const ConvexBody plate = MakeHull(MakeBox({2, 1, 1e-4}).vertices);
  EXPECT_EQ(plate.vertices.cols(), 8);
  EXPECT_NEAR(Support(plate, Vector3d::UnitZ()), 5e-5, 1e-15);
}

TEST(ConvexBody, DegenerateHullsAreRefusedWithASentenceAndNothingPrinted) {
  std::mt19937 random(6);
  Eigen::Matrix3Xd flat = RandomPoints(20, &random), line = flat, point = flat, wild = flat;
  flat.row(2) = 0.3 * flat.row(0);
  line.row(1) = line.row(2) = line.row(0);
  point.colwise() = Vector3d(1, 2, 3);
  wild(1, 7) = std::numeric_limits<double>::quiet_NaN();
  Eigen::Matrix3Xd nearly = flat;
  nearly.row(2) += 1e-11 * RandomPoints(20, &random).row(0);
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  EXPECT_THAT(RefusalOf([&] { MakeHull(flat); }), testing::HasSubstr("coplanar"));
  EXPECT_THAT(RefusalOf([&] { MakeHull(nearly); }), testing::HasSubstr("coplanar"));
  EXPECT_THAT(RefusalOf([&] { MakeHull(line); }), testing::HasSubstr("collinear"));
  EXPECT_THAT(RefusalOf([&] { MakeHull(point); }), testing::HasSubstr("coincide"));
  EXPECT_THAT(RefusalOf([&] { MakeHull(wild); }), testing::HasSubstr("not finite"));
  EXPECT_THAT(RefusalOf([&] { MakeHull(flat.leftCols(3)); }), testing::HasSubstr("there are 3"));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST(ConvexBody, PrimitivesDemandPositiveSizes) {
  EXPECT_THROW(MakeBox({1, 0, 1}), std::logic_error);
  EXPECT_THROW(MakeSphere(-1), std::logic_error);
  EXPECT_THROW(MakeCylinder(1, std::numeric_limits<double>::quiet_NaN()), std::logic_error);
  EXPECT_THROW(MakeCapsule(std::numeric_limits<double>::infinity(), 1), std::logic_error);
}

}  // namespace
}  // namespace halfstep
