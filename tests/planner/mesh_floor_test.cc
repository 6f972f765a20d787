#include "planner/scene/mesh_floor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <variant>

#include "planner/scene/scene.h"
#include "tests/temporary_folder.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

using testing::HasSubstr;

// A floor of 2 × 2 m whose middle is at `height`, and a wall of 1 m at its end.
constexpr const char* kRoom =
    "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv 0 0 HEIGHT\nv 1 -1 1\nv 1 1 1\n"
    "f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\nf 2 3 7\nf 2 7 6\n";

std::string Room(const std::string& height) {
  std::string text = kRoom;
  return text.replace(text.find("HEIGHT"), 6, height);
}

class MeshFloor : public testing::Test {
 protected:
  Scene Load(const std::string& height, const std::string& keys, const std::string& rest = "") {
    std::ofstream(folder_.path() / "room.obj") << Room(height);
    return ParseScene(
        (folder_.path() / "scene.yaml").string(),
        "obstacles:\n  - {name: room, mesh: {file: room.obj" + keys + "}" + rest + "}\n");
  }
  std::string Complaint(const std::string& height, const std::string& keys,
                        const std::string& rest = "") {
    try {
      (void)Load(height, keys, rest);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  TemporaryFolder folder_;
};

TEST_F(MeshFloor, IsTakenOutAndWhatSticksOutStays) {
  const Scene scene = Load("0.004", ", floor: in_mesh");
  const auto& mesh = std::get<TriangleMesh>(scene.obstacles[0].shape);
  EXPECT_TRUE(mesh.hollow);
  EXPECT_EQ(mesh.triangles.cols(), 2) << "the wall";
  EXPECT_EQ(mesh.vertices.cols(), 4) << "its corners only";
  EXPECT_EQ(mesh.vertices.row(0).minCoeff(), 1);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_THAT(scene.warnings[0], HasSubstr("obstacle room: floor: in_mesh: 4 of 6 triangles"));
  EXPECT_THAT(scene.warnings[0], HasSubstr("up to 4 mm"));
}

TEST_F(MeshFloor, StaysWhereNobodySaysSo) {
  const Scene scene = Load("0.004", "");
  const auto& mesh = std::get<TriangleMesh>(scene.obstacles[0].shape);
  EXPECT_FALSE(mesh.hollow);
  EXPECT_EQ(mesh.triangles.cols(), 6);
  EXPECT_TRUE(scene.warnings.empty());
}

TEST_F(MeshFloor, WhatIsHigherThanTheToleranceIsInTheWay) {
  const auto left = [&](const std::string& height, const std::string& keys) {
    const Scene scene = Load(height, keys);
    return std::get<TriangleMesh>(scene.obstacles[0].shape).triangles.cols();
  };
  EXPECT_EQ(left("0.006", ", floor: in_mesh"), 6);
  EXPECT_EQ(left("0.006", ", floor: in_mesh, floor_tolerance_m: 0.006"), 2);
  EXPECT_EQ(left("0.006", ", floor: in_mesh, floor_tolerance_m: 0.0059"), 6);
}

TEST_F(MeshFloor, AHoleIsTold) {
  EXPECT_THAT(Load("-0.3", ", floor: in_mesh").warnings[0],
              HasSubstr("4 triangles of the floor reach below"));
}

TEST_F(MeshFloor, IsWhereThePosePutsIt) {
  const Scene lifted = Load("0", ", floor: in_mesh", ", pose: {xyz: [0, 0, 0.1]}");
  EXPECT_EQ(std::get<TriangleMesh>(lifted.obstacles[0].shape).triangles.cols(), 6);
  const Scene turned = Load("0", ", floor: in_mesh", ", pose: {rpy_deg: [0, 90, 0]}");
  EXPECT_LT(std::get<TriangleMesh>(turned.obstacles[0].shape).triangles.cols(), 6);
}

TEST_F(MeshFloor, WhatMakesNoSenseIsRefused) {
  EXPECT_THAT(Complaint("0", ", floor: in_mesh", ", motion: {error_m: 0.01}"),
              HasSubstr("mesh: brings the floor along and moves"));
  EXPECT_THAT(Complaint("0", ", floor: in_mesh, hull_vertices: 24"),
              HasSubstr("in_mesh beside hull_vertices"));
  EXPECT_THAT(Complaint("0", ", floor: in_mesh, floor_tolerance_m: 0.03"),
              HasSubstr("0.03 is out of range (valid: 0 … 0.02 m)"));
  EXPECT_THAT(Complaint("0", ", floor: mesh"), HasSubstr("valid: none, in_mesh"));
  EXPECT_THAT(Complaint("0", ", floor: in_mesh", ", pose: {xyz: [0, 0, -2]}"),
              HasSubstr("nothing of it sticks out of the floor"));
}

// Of 1 × 1 m, level.
TriangleMesh Square() {
  TriangleMesh square;
  square.vertices.resize(3, 4);
  square.vertices << 0, 1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0;
  square.triangles.resize(3, 2);
  square.triangles << 0, 0, 1, 2, 2, 3;
  return square;
}

TEST(CutFloor, GoesByTheFloorsHeight) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation().z() = 0.104;
  const CutMesh cut = CutFloor(Square(), X, 0.1, 0.005);
  EXPECT_EQ(cut.floor, 2);
  EXPECT_NEAR(cut.highest, 0.004, 1e-12);
  EXPECT_EQ(cut.deep, 0);
  EXPECT_EQ(CutFloor(Square(), X, 0.0, 0.005).floor, 0);
  EXPECT_EQ(CutFloor(Square(), X, 0.2, 0.005).deep, 2);
}

TEST(FloorArea, CountsWhatIsLevelAndNearTheFloor) {
  const TriangleMesh square = Square();
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  EXPECT_NEAR(FloorArea(square, X, 0.0, 0.005), 1.0, 1e-12);
  X.translation().z() = 0.006;
  EXPECT_EQ(FloorArea(square, X, 0.0, 0.005), 0.0);
  EXPECT_NEAR(FloorArea(square, X, 0.002, 0.005), 1.0, 1e-12) << "above the floor, wherever it is";
  X.translation().z() = 0;
  X.linear() = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX()).toRotationMatrix();
  EXPECT_EQ(FloorArea(square, X, 0.0, 2.0), 0.0) << "a ramp is no floor";
}

}  // namespace
}  // namespace halfstep
