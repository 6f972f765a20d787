#include "planner/collision/separation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "planner/collision/convex_distance.h"
#include "tests/draws.h"
#include "tests/planner/brute_force_distance.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Isometry3d At(double x, double y, double z) { return Isometry3d(Eigen::Translation3d(x, y, z)); }

class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  double Uniform(double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(random_);
  }
  Vector3d Point(double reach) {
    const double x = Uniform(-reach, reach), y = Uniform(-reach, reach);
    return {x, y, Uniform(-reach, reach)};
  }
  Isometry3d Pose(double reach) {
    const Vector3d axis = Point(1).normalized();
    return Eigen::Translation3d(Point(reach)) *
           Eigen::AngleAxisd(Uniform(0, std::numbers::pi), axis);
  }
  ConvexBody Hull() {
    const int count = static_cast<int>(Uniform(4, 16));
    const Vector3d size(Uniform(0.02, 0.3), Uniform(0.02, 0.3), Uniform(0.02, 0.3));
    Eigen::Matrix3Xd points(3, count);
    for (int i = 0; i < count; ++i) points.col(i) = Point(1).normalized().cwiseProduct(size);
    return MakeHull(points);
  }
  ConvexBody Box() { return MakeBox({Uniform(0.01, 0.5), Uniform(0.01, 0.5), Uniform(1e-4, 0.5)}); }
  ConvexBody Any() {
    switch (static_cast<int>(Uniform(0, 5))) {
      case 0:
        return MakeSphere(Uniform(0.01, 0.2));
      case 1:
        return MakeCylinder(Uniform(0.01, 0.2), Uniform(0.01, 0.5));
      case 2:
        return MakeCapsule(Uniform(0.01, 0.2), Uniform(0.01, 0.5));
      case 3:
        return Box();
      default:
        return Hull();
    }
  }

 private:
  std::mt19937 random_;
};

TriangleMesh AsMesh(const ConvexBody& body) {
  TriangleMesh mesh{body.vertices, Eigen::Matrix3Xi(3, body.triangles.size())};
  for (size_t i = 0; i < body.triangles.size(); ++i) {
    mesh.triangles.col(static_cast<Eigen::Index>(i)) = body.triangles[i];
  }
  return mesh;
}

// An L of two boxes, 1 × 1 × 0.2 m, with the corner at the origin: open towards +x +y.
TriangleMesh LShape() {
  const TriangleMesh box = AsMesh(MakeBox({1, 0.2, 0.2}));
  TriangleMesh mesh{Eigen::Matrix3Xd(3, 16), Eigen::Matrix3Xi(3, 24)};
  mesh.vertices.leftCols(8) = box.vertices.colwise() + Vector3d(0.5, 0, 0);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitZ()).matrix();
  mesh.vertices.rightCols(8) = turn * mesh.vertices.leftCols(8);
  mesh.triangles.leftCols(12) = box.triangles;
  mesh.triangles.rightCols(12) = box.triangles.array() + 8;
  return mesh;
}

double Distance(const CollisionShape& a, const Isometry3d& X_Wa, const CollisionShape& b,
                const Isometry3d& X_Wb) {
  return Separate(a, X_Wa, b, X_Wb).distance;
}

TEST(Separation, KnownDistances) {
  const CollisionShape sphere(MakeSphere(0.1)), box(MakeBox({2, 2, 2}));
  const CollisionShape cylinder(MakeCylinder(0.2, 1)), capsule(MakeCapsule(0.1, 1));
  const Isometry3d X = At(0, 0, 0);
  EXPECT_NEAR(Distance(sphere, At(1.3, 0.2, 0.1), box, X), 0.2, 1e-9);
  EXPECT_NEAR(Distance(sphere, At(2, 2, 0), box, X), std::sqrt(2) - 0.1, 1e-9);
  EXPECT_NEAR(Distance(sphere, At(2, 2, 2), box, X), std::sqrt(3) - 0.1, 1e-9);
  // Edge against edge: the boxes are turned by 45° about x and y.
  const Isometry3d X_a = At(0, 0, 3.5) * Eigen::AngleAxisd(std::numbers::pi / 4, Vector3d::UnitX());
  const Isometry3d X_b(Eigen::AngleAxisd(std::numbers::pi / 4, Vector3d::UnitY()));
  EXPECT_NEAR(Distance(box, X_a, box, X_b), 3.5 - 2 * std::sqrt(2), 1e-9);
  EXPECT_NEAR(Distance(cylinder, At(1.5, 0, 0), box, X), 0.3, 1e-9);
  EXPECT_NEAR(Distance(cylinder, At(1.5, 1.7, 0), box, X), std::hypot(0.5, 0.7) - 0.2, 1e-9);
  // Rim against face: lower by r·sin + (l/2)·cos of the tilt.
  const Isometry3d tilted = At(0, 0, 2) * Eigen::AngleAxisd(0.5, Vector3d::UnitX());
  EXPECT_NEAR(Distance(cylinder, tilted, box, X), 1 - 0.2 * std::sin(0.5) - 0.5 * std::cos(0.5),
              1e-6);
  EXPECT_NEAR(Distance(capsule, At(0, 0.5, 0), capsule, X), 0.3, 1e-9);
  EXPECT_NEAR(Distance(capsule, At(0, 0.3, 1.4), capsule, X), 0.5 - 0.2, 1e-9);
  const Isometry3d lying = At(0.4, 0, 0) * Eigen::AngleAxisd(1.0, Vector3d::UnitX());
  EXPECT_NEAR(Distance(capsule, lying, capsule, X), 0.2, 1e-9);
}

TEST(Separation, WitnessesAndNormalOfDisjointBodiesFit) {
  Draw draw(11);
  int disjoint = 0;
  for (int i = 0; i < 300; ++i) {
    const ConvexBody a = draw.Any(), b = draw.Any();
    const Isometry3d X_Wa = draw.Pose(0.5), X_Wb = draw.Pose(0.5);
    const Separation s = Separate(CollisionShape(a), X_Wa, CollisionShape(b), X_Wb);
    EXPECT_NEAR(s.normal_W.norm(), 1, 1e-12);
    EXPECT_NEAR(SeparationAlong(a, X_Wa, b, X_Wb, s.normal_W), s.distance, 1e-12);
    if (s.distance <= 0) continue;
    ++disjoint;
    EXPECT_NEAR((s.point_a_W - s.point_b_W).norm(), s.distance, 1e-6);
    EXPECT_NEAR((s.point_a_W - s.point_b_W).dot(s.normal_W), s.distance, 1e-6);
  }
  EXPECT_GT(disjoint, 150);
}

// Truth by brute force over all features; a third of the pairs are brought within 1e-6 … 1e-2 m.
TEST(Separation, OfPolytopesNeverExceedsTheTruthAndMeetsIt) {
  Draw draw(12);
  int disjoint = 0, overlapping = 0;
  for (int i = 0; i < Draws(300); ++i) {
    const ConvexBody a = draw.Hull(), b = i % 2 ? draw.Hull() : draw.Box();
    const Isometry3d X_Wa = draw.Pose(0.3);
    Isometry3d X_Wb = draw.Pose(0.3);
    Separation s = Separate(CollisionShape(a), X_Wa, CollisionShape(b), X_Wb);
    if (i % 3 == 0 && s.distance > 0.01) {
      const double wanted = std::pow(10, draw.Uniform(-6, -2));
      X_Wb.translation() += (s.distance - wanted) * s.normal_W;
      s = Separate(CollisionShape(a), X_Wa, CollisionShape(b), X_Wb);
      EXPECT_NEAR(s.distance, wanted, 1e-8);
    }
    const double slab = WidestAxisSlab(a, X_Wa, b, X_Wb);
    const bool apart = slab > 0;
    (apart ? disjoint : overlapping) += 1;
    const double truth = apart ? SurfaceDistance(Triangles(a, X_Wa), Triangles(b, X_Wb)) : slab;
    EXPECT_LE(s.distance, truth + 1e-12);
    EXPECT_GE(s.distance, truth - (apart ? 1e-8 : 0.01));
  }
  EXPECT_GT(disjoint, Draws(100));
  EXPECT_GT(overlapping, Draws(40));
}

// A cylinder holds an inscribed prism and lies in a circumscribed one.
TEST(Separation, OfCylindersLiesBetweenThoseOfPrisms) {
  Draw draw(13);
  constexpr int kSides = 24;
  for (int i = 0; i < Draws(30); ++i) {
    const double radius = draw.Uniform(0.02, 0.2), length = draw.Uniform(0.02, 0.4);
    const auto prism = [&](double r) {
      Eigen::Matrix3Xd points(3, 2 * kSides);
      for (int k = 0; k < 2 * kSides; ++k) {
        const double angle = 2 * std::numbers::pi * k / kSides;
        points.col(k) << r * std::cos(angle), r * std::sin(angle),
            (k < kSides ? -length : length) / 2;
      }
      return MakeHull(points);
    };
    const ConvexBody box = draw.Box(), inner = prism(radius);
    const ConvexBody outer = prism(radius / std::cos(std::numbers::pi / kSides));
    const Isometry3d X_Wa = draw.Pose(0.1), X_Wb = draw.Pose(0.5);
    const double found =
        Distance(CollisionShape(MakeCylinder(radius, length)), X_Wa, CollisionShape(box), X_Wb);
    if (WidestAxisSlab(outer, X_Wa, box, X_Wb) <= 0) continue;
    const auto of_box = Triangles(box, X_Wb);
    EXPECT_LE(found, SurfaceDistance(Triangles(inner, X_Wa), of_box) + 1e-12);
    EXPECT_GE(found, SurfaceDistance(Triangles(outer, X_Wa), of_box) - 1e-6);
  }
}

TEST(Separation, BothBoundsOfTheDistanceMeet) {
  Draw draw(14);
  for (int i = 0; i < 1500; ++i) {
    const ConvexBody a = draw.Any(), b = draw.Any();
    const Isometry3d X_AB = draw.Pose(0.5);
    const ConvexDistance d = FindConvexDistance(a, b, X_AB, -X_AB.translation(), kConverge);
    if (d.upper == 0) continue;
    EXPECT_LE(d.lower, d.upper + 1e-12);
    EXPECT_GE(d.lower, d.upper - 1e-6);
  }
}

TEST(Separation, IsSymmetricAndInvariantUnderMotion) {
  Draw draw(15);
  for (int i = 0; i < 300; ++i) {
    const CollisionShape a(draw.Any()),
        b(i % 10 ? CollisionShape(draw.Any()) : CollisionShape(LShape()));
    const Isometry3d X_Wa = draw.Pose(0.5), X_Wb = draw.Pose(0.5), X = draw.Pose(3);
    const Separation s = Separate(a, X_Wa, b, X_Wb), t = Separate(b, X_Wb, a, X_Wa);
    const double tolerance = s.distance > 0 ? 1e-6 : 0.02;
    EXPECT_NEAR(s.distance, t.distance, tolerance);
    EXPECT_TRUE(s.distance < 1e-3 || (s.normal_W + t.normal_W).norm() < 1e-2);
    EXPECT_NEAR(Distance(a, X * X_Wa, b, X * X_Wb), s.distance, tolerance);
  }
}

TEST(Separation, PenetrationOfPrimitivesAndTouching) {
  const CollisionShape sphere(MakeSphere(0.1)), box(MakeBox({2, 2, 2}));
  const Isometry3d X = At(0, 0, 0);
  EXPECT_NEAR(Distance(sphere, At(0.15, 0, 0), sphere, X), -0.05, 1e-12);
  EXPECT_NEAR(Distance(sphere, At(1.05, 0.3, 0), box, X), -0.05, 1e-12);
  EXPECT_NEAR(Distance(sphere, At(0.9, 0.3, 0), box, X), -0.2, 1e-9);
  EXPECT_NEAR(Distance(box, At(1.9, 0.3, 0), box, X), -0.1, 1e-9);
  EXPECT_NEAR(Distance(box, X, box, X), -2, 1e-9);
  EXPECT_NEAR(Distance(sphere, X, sphere, X), -0.2, 1e-9);
  EXPECT_NEAR(Distance(box, At(2, 0.3, 0.1), box, X), 0, 1e-10);
  EXPECT_NEAR(Distance(sphere, At(1.1, 0, 0), box, X), 0, 1e-10);
}

TEST(Separation, ThinPlatesAreSeenFromBothSides) {
  const CollisionShape plate(MakeBox({1e-4, 2, 1})), foot(MakeBox({0.24, 0.14, 0.1}));
  for (const double side : {-1.0, 1.0}) {
    EXPECT_NEAR(Distance(foot, At(side * 0.13, 0, 0), plate, At(0, 0, 0)), 0.01 - 5e-5, 1e-12);
  }
  EXPECT_LT(Distance(foot, At(0.02, 0, 0), plate, At(0, 0, 0)), -0.09);
  EXPECT_LT(Distance(CollisionShape(MakeCylinder(0.02, 0.3)), At(0, 0, 0), plate, At(0, 0, 0)),
            -0.0199);
}

TEST(Separation, FromAMeshIsTheBruteForceDistance) {
  Draw draw(16);
  const TriangleMesh mesh = LShape();
  const CollisionShape shape(mesh);
  int disjoint = 0;
  for (int i = 0; i < 150; ++i) {
    const ConvexBody body = i % 2 ? draw.Hull() : draw.Box();
    const Isometry3d X_Wa = draw.Pose(0.8), X_Wb = draw.Pose(0.2);
    const double found = Distance(CollisionShape(body), X_Wa, shape, X_Wb);
    if (found <= 0) continue;
    ++disjoint;
    const double truth = SurfaceDistance(Triangles(body, X_Wa), Triangles(mesh, X_Wb));
    EXPECT_LE(found, truth + 1e-12);
    EXPECT_GE(found, truth - 1e-8);
  }
  EXPECT_GT(disjoint, 80);
}

TEST(Separation, RoundBodiesNearAMeshKeepTheLowerBound) {
  const CollisionShape mesh(LShape());
  const Isometry3d X = At(0, 0, 0);
  // In the corner of the L, 0.4 m from both of its arms: the hull says overlap.
  const auto expect_near = [&](const ConvexBody& body, double truth, double slack) {
    const double found = Distance(CollisionShape(body), At(0.5, 0.3, 0), mesh, X);
    EXPECT_LE(found, truth);
    EXPECT_GE(found, truth - slack);
  };
  expect_near(MakeSphere(0.05), 0.15, 2e-6);
  expect_near(MakeCapsule(0.05, 0.1), 0.15, 2e-6);
  expect_near(MakeCylinder(0.05, 0.1), 0.15, 1e-4);
  EXPECT_NEAR(Distance(CollisionShape(MakeSphere(0.05)), At(0.5, 0.14, 0), mesh, X), -0.01, 2e-6);
}

TEST(Separation, ContainmentInAndOfAMeshIsContact) {
  const CollisionShape big(AsMesh(MakeBox({2, 2, 2}))), small(MakeBox({0.1, 0.1, 0.1}));
  EXPECT_LT(Distance(small, At(0.3, 0.2, 0.1), big, At(0, 0, 0)), -0.7);
  EXPECT_LT(Distance(big, At(0, 0, 0), small, At(0.3, 0.2, 0.1)), -0.7);
  EXPECT_NEAR(Distance(small, At(1.3, 0, 0), big, At(0, 0, 0)), 0.25, 1e-9);
  const CollisionShape crumb(AsMesh(MakeBox({0.1, 0.1, 0.1})));
  for (const ConvexBody& body : {MakeBox({2, 2, 2}), MakeSphere(1), MakeCylinder(1, 2)}) {
    EXPECT_LT(Distance(CollisionShape(body), At(0, 0, 0), crumb, At(0.3, 0.2, 0.1)), -0.3);
  }
  // Two crumbs, one of them inside.
  TriangleMesh crumbs = LShape();
  crumbs.vertices *= 0.01;
  crumbs.vertices.leftCols(8).colwise() += Vector3d(5, 0, 0);
  EXPECT_LE(
      Distance(CollisionShape(MakeSphere(0.3)), At(0, 0, 0), CollisionShape(crumbs), At(0, 0, 0)),
      -0.2);
}

TEST(Separation, FlatMeshesWork) {
  TriangleMesh plate{Eigen::Matrix3Xd(3, 4), Eigen::Matrix3Xi(3, 2)};
  plate.vertices << 0, 1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0;
  plate.triangles << 0, 0, 1, 2, 2, 3;
  const CollisionShape shape(plate), box(MakeBox({0.2, 0.2, 0.2}));
  EXPECT_NEAR(Distance(box, At(0.5, 0.5, 0.3), shape, At(0, 0, 0)), 0.2, 1e-9);
  EXPECT_LE(Distance(box, At(0.5, 0.5, 0.05), shape, At(0, 0, 0)), 0);
}

// A plate of 1 cm across the way, 30 cm high, and five vertices far away in a triangle or two.
TriangleMesh PlateWithFarVertices(double far) {
  const TriangleMesh plate = AsMesh(MakeBox({0.01, 1.2, 0.3}));
  TriangleMesh mesh{Eigen::Matrix3Xd(3, 13), Eigen::Matrix3Xi(3, 14)};
  mesh.vertices.leftCols(8) = plate.vertices.colwise() + Vector3d(0, 0, 0.15);
  mesh.vertices.rightCols(5) << far, far, far, 0.9 * far, 0.8 * far,  //
      0, far, -far, 0.5 * far, 0.1 * far,                             //
      0, 0.3 * far, 0.1 * far, -far, far;
  mesh.triangles.leftCols(12) = plate.triangles;
  mesh.triangles.rightCols(2) << 8, 9, 9, 10, 11, 12;
  return mesh;
}

// The polygon around a disc stands out by 0.1 mm at most, and never in.
TEST(Separation, DiscsBetweenTwoBlocksOfAMesh) {
  for (const double radius : {0.01, 0.08, 0.3, 1.0, 4.0}) {
    const TriangleMesh right = FacesOf(MakeBox({2, 2, 2}));
    TriangleMesh both;
    both.vertices.resize(3, 16);
    both.vertices << right.vertices.colwise() + Vector3d(2 + radius, 0, 0),
        right.vertices.colwise() - Vector3d(2 + radius, 0, 0);
    both.triangles.resize(3, 24);
    both.triangles << right.triangles, right.triangles.array() + 8;
    const CollisionShape blocks(both), disc(MakeCylinder(radius, 1));
    for (int i = 0; i < 50; ++i) {
      Isometry3d X = At(0, 0, 0);
      X.rotate(Eigen::AngleAxisd(0.1 * i, Vector3d::UnitZ()));
      const double distance = Distance(disc, X, blocks, At(0, 0, 0));
      EXPECT_LE(distance, 1 + 1e-12) << radius;
      EXPECT_GE(distance, 1 - 1.01e-4) << radius;
    }
  }
}

TEST(Separation, FarVerticesOfAMeshNeverAddToADistance) {
  Draw draw(19);
  for (const double far : {1e3, 1e7, 9e8, 9e14}) {
    const TriangleMesh mesh = PlateWithFarVertices(far);
    const CollisionShape shape(mesh);
    const Isometry3d X = At(0, 0, 0);
    const TriangleMesh near{mesh.vertices.leftCols(8), mesh.triangles.leftCols(12)};
    int apart = 0;
    for (int i = 0; i < Draws(200); ++i) {
      const ConvexBody body = MakeBox({0.1, 0.1, 0.3});
      Isometry3d X_WB = draw.Pose(0.1);
      X_WB.translation() += Vector3d(i % 2 ? -0.25 : 0.25, 0, 0.15);
      const double truth = SurfaceDistance(Triangles(body, X_WB), Triangles(near, X));
      const double found = Distance(CollisionShape(body), X_WB, shape, X);
      EXPECT_LE(found, truth + 1e-12) << far;
      Vector3d normal_W = Vector3d::Zero();
      EXPECT_FALSE(ClearsAlongCached(CollisionShape(body), X_WB, shape, X,
                                     std::max(truth, 0.0) + 1e-9, &normal_W))
          << far;
      if (far < 1e4 && found > 0) {
        EXPECT_GE(found, truth - 1e-8);
      }
      apart += found > 0;
    }
    if (far < 1e8) {
      EXPECT_GT(apart, Draws(100)) << far;
    }
    // Through the plate.
    EXPECT_LE(Distance(CollisionShape(MakeBox({0.1, 0.1, 0.3})), At(0, 0, 0.1), shape, X), 0);
  }
}

TEST(Separation, PosesThatAreNotFiniteThrow) {
  const CollisionShape box(MakeBox({1, 1, 1})), mesh(AsMesh(MakeBox({1, 1, 1})));
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const Isometry3d X_bad = At(bad, 0, 0), X = At(5, 0, 0);
    Vector3d normal(1, 0, 0);
    EXPECT_THROW(Separate(box, X_bad, box, X), std::logic_error);
    EXPECT_THROW(Separate(box, X, mesh, X_bad), std::logic_error);
    EXPECT_THROW(ClearsAlongCached(box, X_bad, box, X, 0.1, &normal), std::logic_error);
  }
  EXPECT_THROW(Separate(mesh, At(0, 0, 0), mesh, At(5, 0, 0)), std::logic_error);
  EXPECT_THROW(SeparationAlong(box.convex(), At(0, 0, 0), box.convex(), At(5, 0, 0), {2, 0, 0}),
               std::logic_error);
}

TEST(Separation, WhatIsRememberedDoesNotChangeTheAnswer) {
  Draw draw(171);
  int remembered = 0;
  for (int i = 0; i < Draws(200); ++i) {
    const CollisionShape a(draw.Any()),
        b(i % 8 ? CollisionShape(draw.Any()) : CollisionShape(LShape()));
    const Isometry3d X_Wa = draw.Pose(0.6), X_Wb = draw.Pose(0.2);
    const double distance = Distance(a, X_Wa, b, X_Wb);
    if (distance <= 0) continue;
    // Near the distance, where rounding decides.
    for (const double off :
         {-1e-6, -2e-9, -1e-9, -3e-10, -1e-10, -1e-12, 0.0, 1e-12, 1e-10, 2e-9}) {
      Vector3d nothing = Vector3d::Zero(), best = Vector3d::Zero();
      ClearsAlongCached(a, X_Wa, b, X_Wb, 10.0, &best);  // too much: the widest slab
      remembered += best.norm() > 0;
      EXPECT_EQ(ClearsAlongCached(a, X_Wa, b, X_Wb, distance + off, &best),
                ClearsAlongCached(a, X_Wa, b, X_Wb, distance + off, &nothing))
          << off;
    }
  }
  EXPECT_GT(remembered, Draws(500));
}

TEST(Separation, CachedDirectionGivesTheVerdictOfSeparate) {
  Draw draw(17);
  for (int i = 0; i < 40; ++i) {
    const CollisionShape a(draw.Any()),
        b(i % 8 ? CollisionShape(draw.Any()) : CollisionShape(LShape()));
    Isometry3d X_Wa = draw.Pose(0.6);
    const Isometry3d X_Wb = draw.Pose(0.2);
    const Vector3d step = draw.Point(0.02);
    Vector3d normal_W = Vector3d::Zero();
    for (int k = 0; k < 40; ++k) {
      X_Wa.translation() += step;
      const double distance = Distance(a, X_Wa, b, X_Wb);
      if (std::abs(distance - 0.05) < 1e-6) continue;
      EXPECT_EQ(ClearsAlongCached(a, X_Wa, b, X_Wb, 0.05, &normal_W), distance >= 0.05);
    }
  }
}

}  // namespace
}  // namespace halfstep
