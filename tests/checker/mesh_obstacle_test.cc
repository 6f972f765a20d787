// Meshes that are no solids with a hull, in the interval checker.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/checker/check_walk.h"
#include "experiments/checker/proof_file.h"
#include "planner/scene/voxel_set.h"
#include "tests/checker/made_run.h"
#include "tests/refusal_of.h"

namespace halfstep::checker {
namespace {

// A step on the empty floor.
const MadeRun& OneStep() {
  static const MadeRun run(R"(robot: hrp2
scene: none
footsteps:
  - {foot: right, x_m: 0.2, y_m: -0.105}
)");
  return run;
}

// Adds the faces of a box from corner to corner.
void AddBox(const Eigen::Vector3d& from, const Eigen::Vector3d& to, TriangleMesh* mesh) {
  const TriangleMesh box = FacesOf(MakeBox(to - from));
  const Eigen::Index vertices = mesh->vertices.cols(), triangles = mesh->triangles.cols();
  mesh->vertices.conservativeResize(3, vertices + box.vertices.cols());
  mesh->vertices.rightCols(box.vertices.cols()) =
      box.vertices.colwise() + Eigen::Vector3d(0.5 * (from + to));
  mesh->triangles.conservativeResize(3, triangles + box.triangles.cols());
  mesh->triangles.rightCols(box.triangles.cols()) =
      box.triangles.array() + static_cast<int>(vertices);
}
// Posts and a lintel, within whose hull the robot walks.
TriangleMesh Gate(double half) {
  TriangleMesh mesh;
  AddBox({0.0, half, 0.0}, {0.2, half + 0.1, 2.0}, &mesh);
  AddBox({0.0, -half - 0.1, 0.0}, {0.2, -half, 2.0}, &mesh);
  AddBox({0.0, -half, 1.9}, {0.2, half, 2.0}, &mesh);
  return mesh;
}
WalkRun Among(TriangleMesh mesh) {
  WalkRun walk = OneStep().walk;
  Obstacle& obstacle = walk.scene.obstacles.emplace_back();
  obstacle.name = "mesh";
  obstacle.shape = std::move(mesh);
  return walk;
}

TEST(MeshObstacle, AGateIsWalkedThroughWhereItIsWide) {
  EXPECT_TRUE(CheckRun(Among(Gate(1.0))).proved());
  const TrajectoryCheck check = CheckRun(Among(Gate(0.1)));
  ASSERT_FALSE(Missed(check).empty());
  for (const TrajectoryFinding* finding : Missed(check)) {
    EXPECT_THAT(finding->subject, testing::HasSubstr(" - mesh"));
  }
}

// The limit is that of the gate's boxes, each by itself.
TEST(MeshObstacle, KeepsWhatItsPartsKeep) {
  WalkRun parts = OneStep().walk;
  const double half = 0.6;
  for (const double y : {half + 0.05, -half - 0.05}) {
    Obstacle& obstacle = parts.scene.obstacles.emplace_back();
    obstacle.name = y > 0.0 ? "left" : "right";
    obstacle.shape = Box{{0.2, 0.1, 2.0}};
    obstacle.X_WO.translation() << 0.1, y, 1.0;
  }
  WalkRun mesh = Among(Gate(half));
  for (double demanded = 0.01; demanded < 0.4; demanded += 0.03) {
    for (WalkRun* walk : {&parts, &mesh}) {
      walk->certificate.demanded.fill(verify::kNotDemanded);
      walk->certificate.demanded[verify::kClearance] = demanded;
    }
    EXPECT_EQ(CheckRun(parts).proved(), CheckRun(mesh).proved()) << demanded;
  }
}

TEST(MeshObstacle, WhatIsInsideIsNotProvedButInAHollowOne) {
  TriangleMesh room;
  AddBox({-3.0, -3.0, -1.0}, {3.0, 3.0, 3.0}, &room);
  EXPECT_FALSE(CheckRun(Among(room)).proved());
  room.hollow = true;
  EXPECT_TRUE(CheckRun(Among(room)).proved());
  AddBox({0.0, -0.2, 0.0}, {0.1, 0.2, 0.2}, &room);
  EXPECT_FALSE(CheckRun(Among(room)).proved());
}

TEST(MeshObstacle, OfCubesNoneMayHoldABody) {
  const auto cubes = [](int half) {
    VoxelSet set(0.1);
    for (int j = -20; j < 20; ++j) {
      for (int k = -20; k < 20; ++k) {
        for (int i = 0; i < 3; ++i) {
          if (std::abs(j) >= half || std::abs(k) > 18) set.Add({i, j, k});
        }
      }
    }
    set.Finish();
    TriangleMesh mesh = set.Surface();
    mesh.cubes = std::make_shared<const VoxelSet>(std::move(set));
    return mesh;
  };
  EXPECT_TRUE(CheckRun(Among(cubes(10))).proved());
  EXPECT_FALSE(CheckRun(Among(cubes(1))).proved());
  EXPECT_FALSE(CheckRun(Among(cubes(0))).proved());
}

TEST(MeshObstacle, NoPlaceOfAPointThatMayBeInACubeIsOutside) {
  VoxelSet set(0.05);
  set.Add({0, 0, 0});
  set.Finish();
  TriangleMesh mesh = set.Surface();
  mesh.cubes = std::make_shared<const VoxelSet>(std::move(set));
  const MeshTree tree(mesh);
  // The middle is outside.
  const auto outside = [&](double wide) {
    return tree.IsOutside({Interval(-0.01 - wide, -0.01 + wide), Interval(0.02), Interval(0.02)});
  };
  EXPECT_TRUE(outside(1e-12));
  EXPECT_FALSE(outside(0.02));
}

TEST(MeshObstacle, IsOutsideWhereARayLeadsAway) {
  const TriangleMesh gate = Gate(1.0);
  const MeshTree tree(gate);
  const auto outside = [&](double x, double y, double z) {
    return tree.IsOutside(VectorOf(Eigen::Vector3d(x, y, z)));
  };
  EXPECT_TRUE(outside(0.1, 0.0, 1.0));
  EXPECT_TRUE(outside(0.1, 0.9, 1.85));
  EXPECT_TRUE(outside(-5.0, 0.0, 1.0));
  EXPECT_FALSE(outside(0.1, 1.05, 1.0));
  EXPECT_FALSE(outside(0.1, 0.3, 1.95));
  EXPECT_EQ(tree.Near(VectorOf(Eigen::Vector3d(0.1, 0.0, 1.0)), 0.5).size(), 0u);
  EXPECT_GT(tree.Near(VectorOf(Eigen::Vector3d(0.1, 0.8, 1.0)), 0.5).size(), 0u);
}

// Of its triangles nothing is handed over.
TEST(MeshObstacle, HasNoProofThatTravelsButByItsHull) {
  ProofFile proof;
  proof.walk = Among(Gate(1.0));
  EXPECT_TRUE(CheckRun(proof.walk, {}, &proof.hints).proved());
  EXPECT_THAT(RefusalOf([&] { ProofText(proof, {}); }), testing::HasSubstr("by its triangles"));
  ProofFile beside;
  beside.walk = Among(Gate(1.0));
  beside.walk.scene.obstacles[0].X_WO.translation().x() = 2.0;
  EXPECT_TRUE(CheckRun(beside.walk, {}, &beside.hints).proved());
  EXPECT_THAT(ProofText(beside, {}), testing::HasSubstr("\"mesh\""));
}

}  // namespace
}  // namespace halfstep::checker
