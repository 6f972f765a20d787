// Point clouds and occupancy maps as obstacles: what is in the way lies inside their cubes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "planner/collision/mesh_interior.h"
#include "planner/collision/separation.h"
#include "planner/scene/scene.h"
#include "planner/scene/voxel_set.h"
#include "tests/temporary_folder.h"
#include "tests/wpg/octomap_bytes.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using testing::HasSubstr;

Vector3d Draw(std::mt19937* random, double reach) {
  std::uniform_real_distribution<double> draw(-reach, reach);
  const double x = draw(*random), y = draw(*random);
  return {x, y, draw(*random)};
}

TEST(VoxelSet, EveryPointOfABallIsInACellAndNoCellIsFar) {
  std::mt19937 random(1);
  for (int k = 0; k < 200; ++k) {
    const double cell = 0.01 + 0.01 * (k % 7), radius = 0.01 + 0.005 * (k % 11);
    VoxelSet cells(cell);
    const Vector3d center = Draw(&random, 2);
    ASSERT_TRUE(cells.AddBall(center, radius));
    cells.Finish();
    for (int i = 0; i < 20; ++i) {
      const Vector3d p = center + radius * Draw(&random, 1).normalized();
      EXPECT_TRUE(cells.Has((p / cell).array().floor().cast<int>()));
    }
    const Eigen::Matrix3Xd corners = cells.Surface().vertices;
    EXPECT_LE((corners.colwise() - center).colwise().norm().maxCoeff(),
              radius + std::sqrt(3.0) * cell + 1e-9);
  }
}

TEST(VoxelSet, ABlockHasTheSurfaceOfItsSides) {
  VoxelSet cells(0.5);
  for (int i = 0; i < 24; ++i) cells.Add({-1 + i % 2, i / 2 % 3, i / 6});
  cells.Add({0, 0, 0});
  cells.Finish();
  EXPECT_EQ(cells.size(), 24u);
  const TriangleMesh mesh = cells.Surface();
  EXPECT_EQ(mesh.triangles.cols(), 2 * 2 * (2 * 3 + 3 * 4 + 4 * 2));
  EXPECT_EQ(mesh.vertices.cols(), 3 * 4 * 5 - 1 * 2 * 3) << "none of the corners inside";
  EXPECT_EQ(Vector3d(mesh.vertices.rowwise().minCoeff()), Vector3d(-0.5, 0, 0));
  EXPECT_EQ(Vector3d(mesh.vertices.rowwise().maxCoeff()), Vector3d(0.5, 1.5, 2));
  double volume = 0;  // by Gauss: positive when turned outward
  for (const Vector3i& t : mesh.triangles.colwise()) {
    const Vector3d a = mesh.vertices.col(t[0]), b = mesh.vertices.col(t[1]);
    volume += a.dot(b.cross(Vector3d(mesh.vertices.col(t[2])))) / 6;
  }
  EXPECT_NEAR(volume, 24 * 0.125, 1e-12);
}

// Cells that touch along an edge or at a corner only make surfaces that are no manifolds.
TEST(VoxelSet, WhatIsInACellIsInsideTheSurface) {
  std::mt19937 random(2);
  std::uniform_int_distribution<int> draw(0, 3);
  int outside = 0;
  for (int k = 0; k < 20; ++k) {
    VoxelSet cells(1.0);
    for (int i = 0; i < 12; ++i) cells.Add({draw(random), draw(random), draw(random)});
    cells.Finish();
    const MeshInterior interior(cells.Surface());
    for (int i = 0; i < 125; ++i) {
      const Vector3i cell(i % 5, i / 5 % 5, i / 25);
      const bool inside = interior.Contains(cell.cast<double>() + Vector3d(0.43, 0.52, 0.61));
      if (cells.Has(cell)) {
        EXPECT_TRUE(inside) << cell.transpose();
      }
      outside += !inside;
    }
  }
  EXPECT_GT(outside, 1000);
}

VoxelSet DrawnCells(int count, int edge, std::mt19937* random) {
  std::uniform_int_distribution<int> draw(0, edge - 1);
  VoxelSet cells(0.05);
  for (int i = 0; i < count; ++i) cells.Add({draw(*random), draw(*random), draw(*random)});
  cells.Finish();
  return cells;
}

TriangleMesh SolidOf(const VoxelSet& cells) {
  TriangleMesh mesh = cells.Surface();
  mesh.cubes = std::make_shared<const VoxelSet>(cells);
  return mesh;
}

// The surface of many cubes falls into very many patches that are not closed, and their winding
// numbers took minutes of a run. Nothing is asked of them: what is inside is exact.
TEST(VoxelSet, InsideItsSurfaceAreItsCellsAndNothingElse) {
  std::mt19937 random(5);
  const VoxelSet cells = DrawnCells(10'000, 30, &random);
  const MeshInterior interior(SolidOf(cells));
  std::uniform_real_distribution<double> draw(-0.2, 1.7);
  int inside = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vector3d point(draw(random), draw(random), draw(random));
    const Vector3i cell = (point / 0.05).array().floor().cast<int>();
    EXPECT_EQ(interior.Contains(point), cells.Has(cell)) << point.transpose();
    inside += cells.Has(cell);
  }
  EXPECT_GT(inside, 2000);
  EXPECT_FALSE(interior.Contains(Vector3d::Constant(1e9))) << "beyond all cells";
}

// A wall of one cube around a room, of which nothing is known to be inside: the room is free.
TEST(VoxelSet, ARoomBetweenCubesIsFreeAndABodyAroundACubeTouchesIt) {
  VoxelSet walls(0.5);
  for (int i = 0; i < 125; ++i) {
    const Vector3i cell(i % 5, i / 5 % 5, i / 25);
    if (cell.minCoeff() == 0 || cell.maxCoeff() == 4) walls.Add(cell);
  }
  walls.Finish();
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation().setConstant(1.25);
  const Eigen::Isometry3d at_origin = Eigen::Isometry3d::Identity();
  const CollisionShape body(MakeBox({0.5, 0.5, 0.5}));
  EXPECT_NEAR(Separate(body, X, CollisionShape(SolidOf(walls)), at_origin).distance, 0.5, 1e-9);
  VoxelSet two(0.1);
  two.Add({12, 12, 12});
  two.Add({99, 0, 0});
  two.Finish();
  EXPECT_LE(Separate(body, X, CollisionShape(SolidOf(two)), at_origin).distance, 0);
}

class CloudScene : public testing::Test {
 protected:
  std::string Write(const std::string& name, const std::string& bytes) {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return name;
  }
  Scene Load(const std::string& shape, const std::string& rest = "") {
    return ParseScene((folder_ / "scene.yaml").string(),
                      "obstacles:\n  - {name: cloud, " + shape + rest + "}\n");
  }
  std::string Complaint(const std::string& shape) {
    try {
      (void)Load(shape);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  static std::string Ply(const std::vector<Vector3d>& points) {
    std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(points.size()) +
                       "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
    for (const Vector3d& p : points) {
      text +=
          std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) + "\n";
    }
    return text;
  }
  TemporaryFolder folder_;
};

TEST_F(CloudScene, NoBodyIsFartherFromACloudThanFromItsBalls) {
  std::mt19937 random(3);
  std::vector<Vector3d> points;
  for (int i = 0; i < 60; ++i) points.push_back((Draw(&random, 0.3) * 1000).array().round() / 1000);
  Write("a.ply", Ply(points));
  const Scene scene = Load("points: {file: a.ply, radius_m: 0.02}");
  ASSERT_EQ(scene.files.size(), 2u);
  EXPECT_EQ(scene.files[1].name, "a.ply");
  const CollisionShape cloud(scene.obstacles[0].shape), body(MakeBox({0.1, 0.05, 0.2}));
  int apart = 0;
  for (int k = 0; k < 100; ++k) {
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    X.translation() = Draw(&random, 0.8);
    const double told = Separate(body, X, cloud, Eigen::Isometry3d::Identity()).distance;
    double least = 1e9;
    for (const Vector3d& p : points) {
      const Vector3d gap =
          ((p - X.translation()).cwiseAbs() - Vector3d(0.05, 0.025, 0.1)).cwiseMax(0.0);
      least = std::min(least, gap.norm() - 0.02);
    }
    EXPECT_LE(told, std::max(least, 0.0) + 1e-9);
    if (least > 0.04) {
      EXPECT_GE(told, least - std::sqrt(3.0) * 0.02 - 1e-6);
    }
    apart += told > 0;
  }
  EXPECT_GT(apart, 30);
}

TEST_F(CloudScene, KnowsItsCubesAndTellsOfPointsThatAreNone) {
  Write("a.ply", Ply({{0, 0, 1}, {0.5, 0, 1}}));
  std::string bytes = Ply({{0, 0, 1}, {0.5, 0, 1}, {7, 7, 7}});
  bytes.replace(bytes.find("7.000000"), 8, "nan");
  Write("b.ply", bytes);
  const Scene scene = Load("points: {file: b.ply, radius_m: 0.01}");
  const auto& mesh = std::get<TriangleMesh>(scene.obstacles[0].shape);
  ASSERT_NE(mesh.cubes, nullptr);
  EXPECT_TRUE(mesh.cubes->Contains({0.5, 0, 1}));
  EXPECT_FALSE(mesh.cubes->Contains({0.25, 0, 1}));
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_THAT(scene.warnings[0], HasSubstr("1 points are nan"));
  EXPECT_TRUE(Load("points: {file: a.ply, radius_m: 0.01}").warnings.empty());
}

TEST_F(CloudScene, FloorIsLeftOutWhereThePosePutsIt) {
  Write("a.ply", Ply({{0, 0, 0}, {0.5, 0, 0.004}, {0, 0, 1}}));
  const Scene all = Load("points: {file: a.ply, radius_m: 0.01}");
  const Scene cut = Load("points: {file: a.ply, radius_m: 0.01, floor_below_m: 0.005}");
  const auto lowest = [](const Scene& scene) {
    return std::get<TriangleMesh>(scene.obstacles[0].shape).vertices.row(2).minCoeff();
  };
  EXPECT_LT(lowest(all), 0);
  EXPECT_GT(lowest(cut), 0.9);
  ASSERT_EQ(cut.warnings.size(), 1u);
  EXPECT_THAT(cut.warnings[0], HasSubstr("2 points at or below z = 0.005 m are floor"));
  const Scene lifted = Load("points: {file: a.ply, radius_m: 0.01, floor_below_m: 0.005}",
                            ", pose: {xyz: [0, 0, 0.5]}");
  EXPECT_LT(lowest(lifted), 0) << "none of them lies on the floor there";
}

TEST_F(CloudScene, OfAMapTheOccupiedCellsAreInTheWayAndTheUnknownOnesByOption) {
  Write("map.bt", SmallBt());
  const auto triangles = [](const Scene& scene) {
    return std::get<TriangleMesh>(scene.obstacles[0].shape).triangles.cols();
  };
  const Scene occupied = Load("octomap: {file: map.bt}");
  EXPECT_EQ(triangles(occupied), 12);
  EXPECT_EQ(triangles(Load("octomap: {file: map.bt, unknown: free}")), 12);
  // All of the block of eight cells but the free one: its surface is that of the block.
  EXPECT_EQ(triangles(Load("octomap: {file: map.bt, unknown: occupied}")), 48);
  const auto& mesh = std::get<TriangleMesh>(occupied.obstacles[0].shape);
  EXPECT_EQ(mesh.vertices.minCoeff(), 0);
  EXPECT_EQ(mesh.vertices.maxCoeff(), 0.05);
}

TEST_F(CloudScene, WhatMakesNoSenseIsRefused) {
  Write("a.ply", Ply({{0, 0, 0}, {5000, 0, 0}}));
  Write("b.ply", "plx\n");
  Write("map.bt", SmallBt());
  EXPECT_THAT(Complaint("points: {file: none.ply, radius_m: 0.01}"), HasSubstr("none.ply"));
  EXPECT_THAT(Complaint("points: {file: b.ply, radius_m: 0.01}"),
              HasSubstr("obstacles[0].points.file: "));
  EXPECT_THAT(Complaint("points: {file: b.ply, radius_m: 0.01}"), HasSubstr("b.ply:1:1: "));
  EXPECT_THAT(Complaint("points: {file: a.ply}"), HasSubstr("points.radius_m: a required key"));
  EXPECT_THAT(Complaint("points: {file: a.ply, radius_m: 0.001}"), HasSubstr("too far from"));
  EXPECT_THAT(Complaint("points: {file: a.ply, radius_m: 0.01}, octomap: {file: map.bt}"),
              HasSubstr("2 shapes (valid: exactly one of"));
  EXPECT_THAT(Complaint("octomap: {file: map.bt, unknown: maybe}"), HasSubstr("free, occupied"));
  EXPECT_THAT(Complaint("octomap: {file: map.bt, floor_below_m: 0.1}"),
              HasSubstr("nothing of it is in the way"));
  const std::string halves("\x01\x80", 2);
  Write("huge.bt", SmallBt("3", &halves));
  EXPECT_THAT(Complaint("octomap: {file: huge.bt}"), HasSubstr("too many cubes"));
}

}  // namespace
}  // namespace halfstep
