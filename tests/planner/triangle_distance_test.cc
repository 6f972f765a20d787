#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "planner/separation.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Isometry3d At(const Vector3d& p) { return Isometry3d(Eigen::Translation3d(p)); }

TEST(TriangleDistance, OfShapesWithKnownDistances) {
  const CollisionShape box(MakeBox({2, 2, 2})), ball(MakeSphere(0.5));
  const CollisionShape capsule(MakeCapsule(0.25, 1)), cylinder(MakeCylinder(0.02, 1));
  const Isometry3d origin = Isometry3d::Identity();
  EXPECT_NEAR(TriangleDistance(box, origin, box, At({3, 0, 0})), 1, 1e-9);
  EXPECT_NEAR(TriangleDistance(box, origin, ball, At({0, 3, 0})), 1.5, 2e-6);
  EXPECT_NEAR(TriangleDistance(capsule, At({0, 0, 3}), ball, origin), 1.75, 4e-6);
  EXPECT_NEAR(TriangleDistance(cylinder, At({1.5, 0, 0}), box, origin), 0.48, 0.02 / 800);
  EXPECT_LE(TriangleDistance(box, origin, box, At({2, 0, 0})), 0);
  EXPECT_LE(TriangleDistance(box, origin, box, At({1, 1, 1})), 0);
}

// The polygon around a disc stands out by 0.1 mm at most.
TEST(TriangleDistance, EnclosesLargeDiscsTightly) {
  const CollisionShape box(MakeBox({2, 2, 2}));
  for (const double radius : {0.01, 0.08, 0.3, 1.0, 4.0}) {
    const CollisionShape disc(MakeCylinder(radius, 1));
    for (int i = 0; i < 50; ++i) {
      const double angle = 0.1 * i;
      Isometry3d X = At({2 + radius, 0, 0});
      X.rotate(Eigen::AngleAxisd(angle, Vector3d::UnitZ()));
      const double distance = TriangleDistance(box, Isometry3d::Identity(), disc, X);
      EXPECT_LE(distance, 1) << radius;
      EXPECT_GE(distance, 1 - 1.01e-4) << radius;
    }
  }
}

TEST(TriangleDistance, FindsOneInsideTheOtherBothWays) {
  const CollisionShape large(MakeBox({2, 2, 2})), hollow(FacesOf(MakeBox({2, 2, 2})));
  const CollisionShape small(MakeBox({0.1, 0.1, 0.1})),
      small_hollow(FacesOf(MakeBox({0.1, 0.1, 0.1})));
  const CollisionShape ball(MakeSphere(0.1));
  const Isometry3d inside = At({0.3, 0.2, 0.1}), beside = At({0, 0, 5});
  for (const CollisionShape* outer : {&large, &hollow}) {
    for (const CollisionShape* inner : {&small, &small_hollow, &ball}) {
      EXPECT_LE(TriangleDistance(*outer, Isometry3d::Identity(), *inner, inside), 0);
      EXPECT_LE(TriangleDistance(*inner, inside, *outer, Isometry3d::Identity()), 0);
      EXPECT_GT(TriangleDistance(*inner, beside, *outer, Isometry3d::Identity()), 3);
    }
  }
}

// Against the slab of support functions, which never exceeds the distance and reaches it.
TEST(TriangleDistance, AgreesWithTheSlabOfRandomHulls) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vector3d(normal(random), normal(random), normal(random)); };
  int disjoint = 0;
  for (int i = 0; i < 500; ++i) {
    const auto hull = [&] {
      Eigen::Matrix3Xd points(3, 12);
      for (auto point : points.colwise()) point = 0.2 * vector();
      return CollisionShape(MakeHull(points));
    };
    const auto pose = [&] {
      Isometry3d X = At(0.4 * vector());
      X.rotate(Eigen::AngleAxisd(3 * normal(random), vector().normalized()));
      return X;
    };
    const CollisionShape a = hull(), b = hull();
    const Isometry3d X_Wa = pose(), X_Wb = pose();
    const double triangles = TriangleDistance(a, X_Wa, b, X_Wb);
    const double slab = Separate(a, X_Wa, b, X_Wb).distance;
    disjoint += slab > 0;
    EXPECT_NEAR(std::max(triangles, 0.0), std::max(slab, 0.0), 1e-7);
  }
  EXPECT_GT(disjoint, 100);
}

TEST(TriangleDistance, RefusesPosesThatAreNotFinite) {
  const CollisionShape box(MakeBox({1, 1, 1}));
  Isometry3d X = Isometry3d::Identity();
  X.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)TriangleDistance(box, X, box, Isometry3d::Identity()), std::logic_error);
}

}  // namespace
}  // namespace halfstep
