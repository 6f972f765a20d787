// The distances of `halfstep verify` against the program's.

#include "experiments/verify/solid.h"

#include <gtest/gtest.h>

#include "planner/collision/separation.h"
#include "tests/oracle/nasty_draws.h"

namespace halfstep::verify {
namespace {

Eigen::Matrix3Xd Points(int n, double size, oracle::Draw* draw) {
  Eigen::Matrix3Xd points(3, n);
  for (int i = 0; i < n; ++i) points.col(i) = draw->Vector(-size, size);
  return points;
}

Eigen::Isometry3d Pose(double reach, oracle::Draw* draw) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = draw->Vector(-reach, reach);
  X.rotate(Eigen::AngleAxisd(draw->Uniform(-3, 3), draw->Vector(-1, 1).normalized()));
  return X;
}

TriangleMesh Box(double half, bool inwards) {
  TriangleMesh mesh = FacesOf(MakeBox({2 * half, 2 * half, 2 * half}));
  if (inwards) mesh.triangles.row(1).swap(mesh.triangles.row(2));
  return mesh;
}

Eigen::Isometry3d At(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

TEST(Solid, OfShapesWithKnownDistances) {
  const Solid box(MakeBox({2, 2, 2})), ball(MakeSphere(0.5));
  const Solid capsule(MakeCapsule(0.25, 1)), cylinder(MakeCylinder(0.02, 1));
  const Eigen::Isometry3d origin = At(0, 0, 0);
  EXPECT_NEAR(Solid::Distance(box, origin, box, At(3, 0, 0)), 1, 1e-12);
  EXPECT_NEAR(Solid::Distance(box, origin, ball, At(0, 3, 0)), 1.5, 1e-12);
  EXPECT_NEAR(Solid::Distance(capsule, At(0, 0, 3), ball, origin), 1.75, 1e-12);
  EXPECT_NEAR(Solid::Distance(cylinder, At(1.5, 0, 0), box, origin), 0.48, 1e-12);
  EXPECT_EQ(Solid::Distance(box, origin, box, At(2, 0, 0)), 0);
  EXPECT_EQ(Solid::Distance(box, origin, box, At(1, 1, 1)), 0);
}

TEST(Solid, OfDiscsIsExactWhicheverWayTheyTurn) {
  const Solid box(MakeBox({2, 2, 2}));
  for (const double radius : {0.01, 0.3, 4.0}) {
    for (int i = 0; i < 50; ++i) {
      Eigen::Isometry3d X = At(2 + radius, 0, 0);
      X.rotate(Eigen::AngleAxisd(0.1 * i, Eigen::Vector3d::UnitZ()));
      const double found = Solid::Distance(box, At(0, 0, 0), Solid(MakeCylinder(radius, 1)), X);
      EXPECT_NEAR(found, 1, 1e-9) << radius;
      EXPECT_LE(found, 1) << radius;
    }
  }
}

TEST(Solid, OfTiltedDiscsIsTheClosedForm) {
  const Solid box(MakeBox({2, 2, 2})), cylinder(MakeCylinder(0.3, 1));
  for (const double tilt : {0.2, 0.7, 1.3}) {
    const double reach = 0.3 * std::cos(tilt) + 0.5 * std::sin(tilt);
    Eigen::Isometry3d X = At(2 + reach, 0, 0);
    X.rotate(Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitY()));
    EXPECT_NEAR(Solid::Distance(box, At(0, 0, 0), cylinder, X), 1, 1e-9) << tilt;
    EXPECT_NEAR(Solid::Distance(cylinder, X, box, At(0, 0, 0)), 1, 1e-9) << tilt;
  }
}

// Against the program's slabs and triangles, which never exceed the distance and reach it.
TEST(Solid, AgreesWithTheProgramsDistances) {
  oracle::Draw draw(11);
  int apart = 0;
  for (int k = 0; k < 400; ++k) {
    const ConvexBody a = MakeHull(Points(5 + draw.Below(20), 0.2, &draw));
    const ConvexBody b = MakeHull(Points(5 + draw.Below(20), 0.2, &draw));
    const Eigen::Isometry3d X_a = Pose(0.3, &draw), X_b = Pose(0.3, &draw);
    const TriangleMesh faces = FacesOf(b);
    const double slab = Separate(CollisionShape(a), X_a, CollisionShape(b), X_b).distance;
    const double triangles = Separate(CollisionShape(a), X_a, CollisionShape(faces), X_b).distance;
    apart += slab > 0;
    EXPECT_NEAR(Solid::Distance(Solid(a), X_a, Solid(b), X_b), std::max(slab, 0.0), 2e-6) << k;
    EXPECT_NEAR(Solid::Distance(Solid(a), X_a, Solid(faces), X_b), std::max(triangles, 0.0), 2e-6)
        << k;
  }
  EXPECT_GT(apart, 50);
}

TEST(Solid, ABodyInsideAClosedPartTouchesItWhicheverWayItTurns) {
  const Solid body(MakeBox({0.1, 0.1, 0.1}));
  const Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d X_beside = X;
  X_beside.translation() = Eigen::Vector3d(2.1, 0, 0);
  for (const bool inwards : {false, true}) {
    EXPECT_EQ(Solid::Distance(body, X, Solid(Box(1, inwards)), X), 0);
    EXPECT_NEAR(Solid::Distance(body, X_beside, Solid(Box(1, inwards)), X), 1.05, 1e-12);
  }
  // Two solids around it of which one is flipped: their winding numbers cancel.
  TriangleMesh both = Box(1, false);
  const TriangleMesh inner = Box(0.5, true);
  both.vertices.conservativeResize(3, 16);
  both.vertices.rightCols(8) = inner.vertices;
  both.triangles.conservativeResize(3, 24);
  both.triangles.rightCols(12) = inner.triangles.array() + 8;
  EXPECT_EQ(Solid::Distance(body, X, Solid(both), X), 0);
}

// A corner of the mesh lies on a ray from the body's first point: that ray says nothing, the others
// do.
TEST(Solid, ARayThroughACornerOfAClosedPartDoesNotLeaveIt) {
  TriangleMesh around;
  around.vertices.resize(3, 4);
  around.vertices << 1, -2, 0, 0, 0.937, 0, -2, 0, 1.071, 0, 0, -2;
  around.triangles.resize(3, 4);
  around.triangles << 0, 0, 0, 1, 1, 2, 3, 3, 2, 3, 1, 2;
  EXPECT_EQ(Solid::Distance(Solid(MakeSphere(0.01)), At(0, 0, 0), Solid(around), At(0, 0, 0)), 0);
  // The same triangles beginning elsewhere: corners 0 and 1 and corners 2 and 3 are first.
  around.triangles << 0, 2, 1, 3, 1, 3, 0, 2, 2, 0, 3, 1;
  EXPECT_EQ(Solid::Distance(Solid(MakeSphere(0.01)), At(0, 0, 0), Solid(around), At(0, 0, 0)), 0);
}

TEST(Solid, BoxAndBallHoldIt) {
  oracle::Draw draw(12);
  const std::vector<ConvexBody> bodies = {MakeBox({1, 2, 3}), MakeSphere(0.5), MakeCapsule(0.25, 1),
                                          MakeCylinder(0.4, 0.1), MakeHull(Points(9, 1, &draw))};
  for (const ConvexBody& body : bodies) {
    std::vector<Solid> solids = {Solid(body)};
    if (body.normals.cols() > 0) solids.emplace_back(FacesOf(body));
    for (const Solid& solid : solids) {
      for (int k = 0; k < 100; ++k) {
        const Eigen::Vector3d p = SupportPoint(body, draw.Vector(-1, 1));
        EXPECT_LE((p - solid.center()).norm(), solid.radius());
        EXPECT_TRUE((p.array() >= solid.lower().array()).all());
        EXPECT_TRUE((p.array() <= solid.upper().array()).all());
      }
    }
  }
}

// A ball that is wide beside the mesh's parts: a part that is farther by boxes may be nearer.
TEST(Solid, DistanceOfABallFromAMeshIsThatOfItsNearestTriangle) {
  oracle::Draw draw(13);
  for (int k = 0; k < 100; ++k) {
    TriangleMesh mesh;
    mesh.vertices = Points(60, 1, &draw);
    mesh.triangles.resize(3, 20);
    for (int i = 0; i < 60; ++i) mesh.triangles(i % 3, i / 3) = i;
    const double radius = draw.Uniform(0.1, 2);
    const Solid ball(MakeSphere(radius)), point(MakeSphere(1e-6));
    const Eigen::Isometry3d X = At(draw.Uniform(3, 5), draw.Uniform(-1, 1), draw.Uniform(-1, 1));
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 20; ++i) {
      TriangleMesh one;
      one.vertices = mesh.vertices.middleCols(3 * i, 3);
      one.triangles = Eigen::Vector3i(0, 1, 2);
      nearest = std::min(nearest, Solid::Distance(point, X, Solid(one), At(0, 0, 0)));
    }
    EXPECT_NEAR(Solid::Distance(ball, X, Solid(mesh), At(0, 0, 0)),
                std::max(nearest + 1e-6 - radius, 0.0), 1e-9);
  }
}

TEST(Solid, TrianglesThatAreThereTwiceBothWaysCountOnce) {
  const TriangleMesh out = Box(1, false), in = Box(1, true);
  TriangleMesh both = out;
  both.triangles.conservativeResize(3, 24);
  both.triangles.rightCols(12) = in.triangles;
  const Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  EXPECT_EQ(Solid::Distance(Solid(MakeBox({0.1, 0.1, 0.1})), X, Solid(both), X), 0);
}

TEST(Solid, APlateSurroundsNothing) {
  const Solid body(MakeBox({0.1, 0.1, 0.1}));
  TriangleMesh corner;  // three triangles that meet in a corner, the body before them
  corner.vertices.resize(3, 4);
  corner.vertices << 0, 5, 0, 0, 0, 0, 5, 0, 0, 0, 0, 5;
  corner.triangles.resize(3, 3);
  corner.triangles << 0, 0, 0, 1, 2, 3, 2, 3, 1;
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = Eigen::Vector3d(0.3, 0.4, 0.5);
  EXPECT_NEAR(Solid::Distance(body, X, Solid(corner), Eigen::Isometry3d::Identity()), 0.25, 1e-12);
}

}  // namespace
}  // namespace halfstep::verify
