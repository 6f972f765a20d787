#include "planner/collision/mesh_interior.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "planner/collision/mesh_patches.h"
#include "planner/collision/separation.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

TriangleMesh BoxAt(const Vector3d& center, const Vector3d& size) {
  TriangleMesh mesh = FacesOf(MakeBox(size));
  mesh.vertices.colwise() += center;
  return mesh;
}

TriangleMesh Flipped(TriangleMesh mesh) {
  mesh.triangles.row(1).swap(mesh.triangles.row(2));
  return mesh;
}

// Both in one mesh, by vertices of their own.
TriangleMesh Joined(const TriangleMesh& a, const TriangleMesh& b) {
  TriangleMesh mesh{Eigen::Matrix3Xd(3, a.vertices.cols() + b.vertices.cols()),
                    Eigen::Matrix3Xi(3, a.triangles.cols() + b.triangles.cols())};
  mesh.vertices << a.vertices, b.vertices;
  mesh.triangles << a.triangles, b.triangles.array() + static_cast<int>(a.vertices.cols());
  return mesh;
}

// Without some of its triangles.
TriangleMesh Without(TriangleMesh mesh, Eigen::Index first, Eigen::Index count) {
  Eigen::Matrix3Xi kept(3, mesh.triangles.cols() - count);
  kept << mesh.triangles.leftCols(first),
      mesh.triangles.rightCols(mesh.triangles.cols() - first - count);
  mesh.triangles = kept;
  return mesh;
}

bool Inside(const TriangleMesh& mesh, const Vector3d& point) {
  return MeshInterior(mesh).Contains(point);
}

const Vector3d kOrigin(0, 0, 0), kCube(2, 2, 2);

TEST(MeshInterior, OfTwoSolidsOneMayBeFlipped) {
  const TriangleMesh outer = BoxAt(kOrigin, kCube), inner = BoxAt({0.2, 0, 0}, {1.2, 1.1, 1});
  for (const TriangleMesh& a : {outer, Flipped(outer)}) {
    for (const TriangleMesh& b : {inner, Flipped(inner)}) {
      const TriangleMesh both = Joined(a, b);
      EXPECT_TRUE(Inside(both, {0.3, 0.1, 0.2})) << "inside both";
      EXPECT_TRUE(Inside(both, {0, 0, 0.8})) << "inside one";
      EXPECT_FALSE(Inside(both, {1.1, 0, 0}));
    }
  }
}

TEST(MeshInterior, TheRobotInsideTwoSolidsIsInContact) {
  const TriangleMesh mesh = Joined(BoxAt(kOrigin, {4, 4, 4}), Flipped(BoxAt(kOrigin, {3, 3, 3})));
  const CollisionShape room(mesh), body(MakeBox({0.1, 0.1, 0.4}));
  const Isometry3d X = Isometry3d::Identity();
  EXPECT_LE(Separate(body, X, room, X).distance, 0);
  Vector3d normal_W = Vector3d::Zero();
  EXPECT_FALSE(ClearsAlongCached(body, X, room, X, 0.005, &normal_W));
}

TEST(MeshInterior, SingleTrianglesMayBeFlipped) {
  std::mt19937 random(1);
  for (int i = 0; i < 50; ++i) {
    TriangleMesh mesh = BoxAt(kOrigin, kCube);
    for (auto t : mesh.triangles.colwise()) {
      if (random() % 2 != 0) std::swap(t[1], t[2]);
    }
    EXPECT_EQ(FindPatches(mesh).size(), 1u);
    EXPECT_TRUE(FindPatches(mesh)[0].closed);
    EXPECT_TRUE(Inside(mesh, {0.9, -0.9, 0.9}));
    EXPECT_FALSE(Inside(mesh, {1.01, 0, 0}));
  }
}

TEST(MeshInterior, DoubledSurfacesCountOnce) {
  const TriangleMesh box = BoxAt(kOrigin, kCube);
  for (const TriangleMesh& again : {box, Flipped(box)}) {
    const TriangleMesh doubled = Joined(box, again);
    EXPECT_TRUE(Inside(doubled, {0.5, 0.5, 0.5}));
    EXPECT_FALSE(Inside(doubled, {1.01, 0, 0}));
  }
}

TEST(MeshInterior, ACavityIsInside) {
  const TriangleMesh shell = Joined(BoxAt(kOrigin, kCube), Flipped(BoxAt(kOrigin, {1, 1, 1})));
  EXPECT_TRUE(Inside(shell, {0, 0, 0}));
  EXPECT_TRUE(Inside(shell, {0.75, 0, 0}));
  EXPECT_FALSE(Inside(shell, {1.5, 0, 0}));
}

// Two boxes that share a corner, an edge, or a face, with the vertices of both.
TEST(MeshInterior, TouchingSolidsDoNotCancel) {
  for (const Vector3d& beside : {Vector3d(2, 2, 2), Vector3d(2, 2, 0), Vector3d(2, 0, 0)}) {
    for (const bool flipped : {false, true}) {
      const TriangleMesh second = BoxAt(beside, kCube);
      const TriangleMesh both = Joined(BoxAt(kOrigin, kCube), flipped ? Flipped(second) : second);
      EXPECT_TRUE(Inside(both, {0.9, 0.1, 0.2})) << beside.transpose();
      EXPECT_TRUE(Inside(both, beside + Vector3d(-0.9, 0.1, 0.2))) << beside.transpose();
      EXPECT_FALSE(Inside(both, {-1.1, 0, 0})) << beside.transpose();
      EXPECT_FALSE(Inside(both, {0, 0, 5})) << beside.transpose();
    }
  }
}

TEST(MeshInterior, CellsOfAHoneycombAreInside) {
  // 3 × 3 × 3 boxes that share their walls: every wall is a patch of its own.
  TriangleMesh comb = BoxAt({-2, -2, -2}, kCube);
  for (int k = 1; k < 27; ++k) {
    const TriangleMesh cell = BoxAt(2.0 * Vector3d(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1), kCube);
    comb = Joined(comb, k % 2 ? Flipped(cell) : cell);
  }
  EXPECT_TRUE(Inside(comb, {0, 0, 0}));
  EXPECT_TRUE(Inside(comb, {2.5, 1.5, -1.5}));
  EXPECT_FALSE(Inside(comb, {20, 0, 0}));
}

TEST(MeshInterior, AClosedSurfaceInPiecesIsInsideHoweverTheyAreTurned) {
  // Each triangle has vertices of its own, a little smaller than the gap that they leave.
  const TriangleMesh box = BoxAt(kOrigin, kCube);
  std::mt19937 random(2);
  for (int i = 0; i < 20; ++i) {
    TriangleMesh pieces{Eigen::Matrix3Xd(3, 36), Eigen::Matrix3Xi(3, 12)};
    for (int t = 0; t < 12; ++t) {
      Eigen::Matrix3d corners;
      for (int k = 0; k < 3; ++k) corners.col(k) = box.vertices.col(box.triangles(k, t));
      const Vector3d middle = corners.rowwise().mean();
      pieces.vertices.middleCols(3 * t, 3) =
          ((corners.colwise() - middle) * (1 - 1e-9)).colwise() + middle;
      const int turned = i > 0 && random() % 2 != 0 ? 1 : 0;
      pieces.triangles.col(t) << 3 * t, 3 * t + 1 + turned, 3 * t + 2 - turned;
    }
    EXPECT_EQ(FindPatches(pieces).size(), 12u);
    EXPECT_TRUE(Inside(pieces, {0.1, 0.2, -0.3})) << i;
    EXPECT_FALSE(Inside(pieces, {5, 0, 0}));
  }
}

TEST(MeshInterior, AnOpenBoxHoldsWhatIsDeepInside) {
  for (const bool flipped : {false, true}) {
    TriangleMesh open = Without(BoxAt(kOrigin, kCube), 0, 2);
    if (flipped) open = Flipped(open);
    EXPECT_FALSE(FindPatches(open)[0].closed);
    EXPECT_TRUE(Inside(open, {0, 0, 0}));
    EXPECT_FALSE(Inside(open, {0, 0, 3}));
    EXPECT_FALSE(Inside(open, {3, 0, 0}));
    EXPECT_FALSE(Inside(open, {-3, 0, 0}));
  }
}

TEST(MeshInterior, TrianglesWithoutAreaAndStrayVerticesDoNotMatter) {
  TriangleMesh mesh = BoxAt(kOrigin, kCube);
  mesh.vertices.conservativeResize(3, 9);
  mesh.vertices.col(8) = Vector3d(7, 7, 7);
  mesh.triangles.conservativeResize(3, 13);
  mesh.triangles.col(12) << 0, 0, 3;
  EXPECT_EQ(FindPatches(mesh).size(), 1u);
  EXPECT_TRUE(FindPatches(mesh)[0].closed);
  EXPECT_TRUE(Inside(mesh, {0, 0, 0}));
}

// A Möbius band turns no way; its triangles are taken one by one.
TEST(MeshPatches, AnEdgeOfThreeTrianglesJoinsNone) {
  TriangleMesh fan{Eigen::Matrix3Xd(3, 5), Eigen::Matrix3Xi(3, 3)};
  fan.vertices << 0, 0, 1, -1, 0, 0, 0, 1, 1, -1, 0, 1, 0, 0, 0;
  fan.triangles << 0, 0, 0, 1, 1, 1, 2, 3, 4;
  const std::vector<MeshPatch> patches = FindPatches(fan);
  EXPECT_EQ(patches.size(), 3u);
  for (const MeshPatch& patch : patches) EXPECT_FALSE(patch.closed);
}

TEST(MeshInterior, ABandThatTurnsNoWayFallsIntoTriangles) {
  constexpr int kPieces = 9;
  TriangleMesh band{Eigen::Matrix3Xd(3, 2 * kPieces), Eigen::Matrix3Xi(3, 2 * kPieces)};
  for (int i = 0; i < kPieces; ++i) {
    const double a = 2 * std::numbers::pi * i / kPieces, half = 0.5 * a;
    const Vector3d out(std::cos(a), std::sin(a), 0);
    const Vector3d across = 0.3 * (std::cos(half) * out + std::sin(half) * Vector3d::UnitZ());
    band.vertices.col(2 * i) = out + across;
    band.vertices.col(2 * i + 1) = out - across;
    const int j = (i + 1) % kPieces;
    // The last piece is joined the other way round.
    const int up = j == 0 ? 1 : 2 * j, down = j == 0 ? 0 : 2 * j + 1;
    band.triangles.col(2 * i) << 2 * i, 2 * i + 1, up;
    band.triangles.col(2 * i + 1) << 2 * i + 1, down, up;
  }
  EXPECT_EQ(FindPatches(band).size(), static_cast<size_t>(2 * kPieces));
  EXPECT_FALSE(Inside(band, {3, 0, 0}));
}

}  // namespace
}  // namespace halfstep
