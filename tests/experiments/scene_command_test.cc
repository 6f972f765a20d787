// `halfstep scene`: what other programs have becomes a scene, and what was left out is told.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>

#include "experiments/commands/commands.h"
#include "planner/scene/scene.h"
#include "tests/experiments/child_process.h"
#include "tests/places.h"
#include "tests/replaced.h"
#include "tests/temporary_folder.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const fs::path kScenery = InSources("tests/fixtures/scenery");

// Converts a fixture, or a file elsewhere, and reads what was written.
struct Converted {
  Scene scene;
  std::string text;

  Converted(const fs::path& file, SceneCommand command = {}, const TemporaryFolder& place = {}) {
    command.file = file.is_absolute() ? file : kScenery / file;
    command.out = place / "scene.yaml";
    command.quiet = true;
    EXPECT_EQ(ConvertScene(command), kSuccess);
    scene = LoadScene(command.out);
    text = ReadText(command.out);
  }
  const Obstacle& operator[](const std::string& name) const {
    for (const Obstacle& obstacle : scene.obstacles) {
      if (obstacle.name == name) return obstacle;
    }
    throw std::runtime_error("no obstacle " + name + " in\n" + text);
  }
  Eigen::AlignedBox3d Bounds(const std::string& name) const {
    return BoundsOf((*this)[name].shape, (*this)[name].X_WO);
  }
};

void ExpectBox(const Eigen::AlignedBox3d& box, const Vector3d& lower, const Vector3d& upper) {
  EXPECT_LT((box.min() - lower).cwiseAbs().maxCoeff(), 1e-9) << box.min().transpose();
  EXPECT_LT((box.max() - upper).cwiseAbs().maxCoeff(), 1e-9) << box.max().transpose();
}

std::string RefusalOf(const std::string& name, const std::string& bytes,
                      SceneCommand command = {}) {
  const TemporaryFolder place;
  command.file = WriteText(place / name, bytes);
  command.out = place / "scene.yaml";
  command.quiet = true;
  try {
    ConvertScene(command);
  } catch (const InputError& error) {
    EXPECT_THAT(NamesIn(place.path()), ElementsAre(name)) << "something was written";
    return error.what();
  }
  return "";
}

TEST(SceneCommand, TakesBothFormsOfMoveItScenes) {
  const Converted older("older.scene");
  ASSERT_EQ(older.scene.obstacles.size(), 2u);
  ExpectBox(older.Bounds("table top"), {0.3, -0.3, 0.68}, {1.3, 0.3, 0.72});
  ExpectBox(older.Bounds("table top_2"), {0.77, -0.03, 0}, {0.83, 0.03, 0.68});
  EXPECT_THAT(older.text, HasSubstr("# floor: its top lies at 0: the floor\n"));
  const Converted newer("newer.scene");
  ASSERT_EQ(newer.scene.obstacles.size(), 4u);
  ExpectBox(newer.Bounds("table top"), {0.5, -0.5, 0.68}, {1.1, 0.5, 0.72});
  ExpectBox(newer.Bounds("table top_2"), {0.77, -0.03, 0}, {0.83, 0.03, 0.68});
  EXPECT_NEAR(newer.Bounds("tip").max().z(), 0.2, 1e-9) << "its tip is up";
  EXPECT_NEAR(newer.Bounds("tip").max().x(), 0.1, 0.1 * 0.0013);
  ExpectBox(newer.Bounds("tip_2"), {0, 1.5, 0}, {0.2, 1.7, 0.2});
}

TEST(SceneCommand, TakesPlanningScenesWithTheirFrames) {
  const Converted shelf("shelf.yaml");
  ASSERT_EQ(shelf.scene.obstacles.size(), 4u);
  ExpectBox(shelf.Bounds("Can1"), {0.77, -0.03, 0.98}, {0.83, 0.03, 1.12});
  ExpectBox(shelf.Bounds("shelf"), {0.4, -0.5, 0.98}, {1.6, 0.5, 1.02});
  ExpectBox(shelf.Bounds("shelf_2"), {0.9, -0.1, 1.1}, {1.1, 0.1, 1.3});
  ExpectBox(shelf.Bounds("shelf_3"), {1, 0, 0.6}, {1.1, 0.1, 0.7});
  EXPECT_THAT(shelf.text, HasSubstr("# robot_state is left out\n"));
  EXPECT_THAT(shelf.text, HasSubstr("# gone: left out, for its operation is to remove it\n"));
  EXPECT_THAT(shelf.text, HasSubstr("frame 'world' is taken for the world"));
}

TEST(SceneCommand, TakesUrdfEnvironmentsAtZero) {
  const Converted room("room.urdf");
  ASSERT_EQ(room.scene.obstacles.size(), 3u) << room.text;
  ExpectBox(room.Bounds("door"), {1.975, -0.45, 0}, {2.025, 0.45, 2});
  ExpectBox(room.Bounds("stone"), {1.5, 1, 0.2}, {2, 1.5, 0.7});
  ExpectBox(room.Bounds("stone_2"), {1.9, 0.9, 0.1}, {2.1, 1.1, 0.3});
  EXPECT_THAT(room.text, HasSubstr("floor: its top lies at 0: the floor"));
  EXPECT_THAT(room.text, HasSubstr("door: has no collision shape; its visual one is taken"));
  EXPECT_THAT(room.text, HasSubstr("rocks/tetra.obj', scale: 0.5")) << "by its relative path";
}

TEST(SceneCommand, TakesSdfWorldsWithWhatTheyInclude) {
  const Converted room("room.world");
  ASSERT_EQ(room.scene.obstacles.size(), 3u) << room.text;
  ExpectBox(room.Bounds("crate"), {1.75, 0.75, 0}, {2.25, 1.25, 0.5});
  ExpectBox(room.Bounds("box"), {2.75, -0.25, 0}, {3.25, 0.25, 0.5});
  ExpectBox(room.Bounds("pole"), {0, -1.05, 0.95}, {2, -0.95, 1.05});
  for (const char* told :
       {"ground_plane: its top lies at 0: the floor", "sun is a light, and left out",
        "light 'lamp' is left out", "actor 'walker' is left out", "plugins of models are left out",
        "'sign' is only to be looked at", "hills: a heightmap is left out"}) {
    EXPECT_THAT(room.text, HasSubstr(told));
  }
  SceneCommand without;
  without.request.without = {"cra*", "pole"};
  EXPECT_EQ(Converted("room.world", without).scene.obstacles.size(), 1u);
}

TEST(SceneCommand, TakesMeshesThatScenesCannotName) {
  const TemporaryFolder place;
  const Converted ply("tetra.ply", {}, place);
  EXPECT_EQ(std::get<TriangleMesh>(ply["tetra"].shape).triangles.cols(), 6);
  ExpectBox(ply.Bounds("tetra"), {0, 0, 0}, {1, 1, 1});
  EXPECT_THAT(NamesIn(place.path()), ElementsAre("scene.yaml", "scene_tetra.obj"));
  SceneCommand smaller;
  smaller.request.scale = 0.1;
  smaller.pose = {2, 0, 0, 90};
  smaller.up = 0.5;
  const Converted gltf("tetra.gltf", smaller);
  // y, which glTF calls up, is z; two of them, the second one twice as large.
  EXPECT_EQ(std::get<TriangleMesh>(gltf["tetra"].shape).triangles.cols(), 8);
  ExpectBox(gltf.Bounds("tetra"), {2, 0, 0.6}, {2.2, 0.5, 0.8});
  EXPECT_THAT(gltf.text, HasSubstr("points and lines are left out"));
  EXPECT_THAT(gltf.text, HasSubstr("animations are left out"));
}

// The same tetrahedron in binary PLY, of both byte orders, and as glb.
TEST(SceneCommand, BinaryMeshesAreThoseOfText) {
  const Eigen::Matrix3Xd expected =
      std::get<TriangleMesh>(Converted("tetra.ply")["tetra"].shape).vertices;
  for (const bool big : {false, true}) {
    const auto number = [big](auto value) {
      std::string bytes(sizeof(value), '\0');
      std::memcpy(bytes.data(), &value, sizeof(value));
      if (big) std::reverse(bytes.begin(), bytes.end());
      return bytes;
    };
    std::string bytes = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                        "_endian 1.0\nelement vertex 5\nproperty double x\nproperty double y\n"
                        "property double z\nelement face 1\nproperty list uchar int vertex_index\n"
                        "end_header\n";
    for (const double x : expected.reshaped()) bytes += number(x);
    bytes += number(std::uint8_t{3}) + number(0) + number(1) + number(4);
    const TemporaryFolder place;
    const Converted ply(WriteText(place / "tetra.ply", bytes));
    EXPECT_EQ(std::get<TriangleMesh>(ply["tetra"].shape).vertices, expected);
    bytes.pop_back();
    EXPECT_THAT(RefusalOf("a.ply", bytes), HasSubstr("the file ends within its data"));
  }
}

TEST(SceneCommand, CloudsAndMapsAreNamed) {
  std::string cloud =
      "ply\nformat ascii 1.0\nelement vertex 60\nproperty float x\n"
      "property float y\nproperty float z\nend_header\n";
  for (int i = 0; i < 60; ++i) cloud += "1 " + std::to_string(i) + (i < 30 ? " 0\n" : " 0.5\n");
  const TemporaryFolder place;
  const std::string file = WriteText(place / "cloud.ply", cloud);
  const Converted points(file, {}, place);
  EXPECT_THAT(points.text,
              HasSubstr("points: {file: 'cloud.ply', radius_m: 0.02, floor_below_m: 0.03}"));
  EXPECT_THAT(points.text, HasSubstr("50 % of its points lie within 0.03 m of 0: the floor"));
  SceneCommand up;
  up.up = 0.5;
  EXPECT_THAT(Converted(file, up).text, HasSubstr("--up -0.5 brings it to 0"));
}

TEST(SceneCommand, HeightsAreBoxesOnAFlatFloor) {
  SceneCommand command;
  command.request.cell = 0.5;
  command.request.height = 1.0;
  const Converted hills("hills.pgm", command);
  ASSERT_EQ(hills.scene.obstacles.size(), 2u) << hills.text;
  ExpectBox(hills.Bounds("height"), {0, -0.25, 0}, {1, 0.75, 0.5});
  ExpectBox(hills.Bounds("height_2"), {-0.5, -0.25, 0}, {0, 0.25, 1});
  EXPECT_THAT(hills.text, HasSubstr("7 of 12 pixels, up to 0 m, are floor"));
  EXPECT_THAT(RefusalOf("a.pgm", "P2 1 1 1 1"), HasSubstr("needs --cell and --height"));
}

TEST(SceneCommand, TellsWhereAFloorLiesElsewhere) {
  SceneCommand up;
  up.up = 0.25;
  const Converted raised("older.scene", up);
  EXPECT_THAT(raised.text, HasSubstr("floor: a level top of 100 m² lies at z = 0.25 m: if that is "
                                     "the floor, --up -0.25 brings it to 0"));
  up.up = -0.25;
  const Converted sunk("older.scene", up);
  EXPECT_THAT(sunk.text, HasSubstr("floor is left out: it lies below the floor, its top at -0.25"));
  EXPECT_THAT(sunk.text, HasSubstr("--up 0.25 brings it to 0"));
}

// A room with its floor in one mesh: its floor is no obstacle, and who stands there is in no solid.
TEST(SceneCommand, AMeshMayBringItsFloor) {
  const TemporaryFolder place;
  const std::string room =
      "v -2 -2 0\nv 2 -2 0\nv 2 2 0\nv -2 2 0\nv -2 -2 2\nv 2 -2 2\nf 1 2 3 4\nf 1 2 6 5\n";
  const Converted scene(WriteText(place / "room.obj", room), {}, place);
  EXPECT_THAT(scene.text, HasSubstr("mesh: {file: 'room.obj', floor: in_mesh}"));
  EXPECT_TRUE(std::get<TriangleMesh>(scene["room"].shape).hollow);
  // Of a chest that stands on the floor the bottom faces down.
  const std::string chest = Replaced(room, "f 1 2 3 4", "f 4 3 2 1");
  const Converted other(WriteText(place / "chest.obj", chest));
  EXPECT_THAT(other.text, Not(HasSubstr("in_mesh")));
}

TEST(SceneCommand, TheSameFileGivesTheSameBytes) {
  for (const char* name : {"newer.scene", "room.world", "tetra.gltf"}) {
    EXPECT_EQ(Converted(name).text, Converted(name).text);
  }
}

TEST(SceneCommand, WhatItCannotReadIsRefusedAtItsPlace) {
  struct Case {
    std::string name, bytes, complaint;
  };
  const std::string scene = ReadText(kScenery / "older.scene");
  const std::string newer = ReadText(kScenery / "newer.scene");
  const std::string yaml = ReadText(kScenery / "shelf.yaml");
  const std::string ply = ReadText(kScenery / "tetra.ply");
  const std::string urdf =
      "<robot name='r'><link name='a'><collision><geometry>\n  <box "
      "size='1 1 1'/></geometry></collision></link></robot>";
  const std::string world = ReadText(kScenery / "room.world");
  for (const Case& c : std::vector<Case>{
           {"a.scene", Replaced(scene, "\n.", "\n"), "the file ends without the line `.`"},
           {"a.scene", Replaced(scene, "1 0.6 0.04", "1 0.6 -0.04"), ":5:7: a size of -0.04 m"},
           {"a.scene", Replaced(scene, "cylinder", "octree"), ":9:1: 'octree' is no shape"},
           {"a.scene", Replaced(scene, "0 0 0 1", "0 0 0 2"), ":7:1: no turn"},
           {"a.scene", Replaced(newer, "4 4", "1000000000 4"), "is no number of vertices"},
           {"a.scene", Replaced(newer, "1 2 3", "1 2 4"), ": '4' is no vertex (valid: 0 … 3)"},
           {"a.yaml", "obstacles: []", ":1:12: obstacles: this is a scene file already"},
           {"a.yaml", "name: x", "has no collision_objects"},
           {"a.yaml", Replaced(yaml, "[0.14, 0.03]", "[0.14]"), ":15:"},
           {"a.yaml", Replaced(yaml, "type: cylinder", "type: tube"), ".type: is 'tube'"},
           {"a.yaml", Replaced(yaml, "[0, 0, -0.4]", "[0, .nan, -0.4]"), "valid: a number"},
           {"a.urdf", Replaced(urdf, "1 1 1", "1 1"), ":2:3: box: has 2 numbers (valid: 3)"},
           {"a.urdf", Replaced(urdf, "box", "bax"), "is no shape"},
           {"a.urdf", Replaced(urdf, "<link", "<xacro:if/><link"), "xacro is not expanded"},
           {"a.urdf", "<!DOCTYPE r [<!ENTITY a 'b'>]><robot/>", "declares entities"},
           {"a.urdf", "<robot", "a.urdf"},
           {"a.xml", "<html/>", "is neither a URDF nor an SDF"},
           {"a.world", world, "'model://box' is not found (valid: --package box=FOLDER"},
           {"a.world", Replaced(world, "middle\" degrees", "nowhere\" degrees"), "a.world"},
           {"a.ply", Replaced(ply, "vertex 5", "vertex 1000000000"), "too many vertices or faces"},
           {"a.ply", Replaced(ply, "vertex 5", "vertex 14000000"), "a.ply"},
           {"a.ply", Replaced(ply, "3 0 1 4 7", "3 0 1 5 7"), ":19:1: no vertex 5 (valid: 0 … 4)"},
           {"a.ply", Replaced(ply, "0.5 0.5 1", "0.5 nan 1"), "'nan'"},
           {"a.pgm", "P2 2 2 255 1 2 3", "needs --cell"},
           {"a.png", "", "needs --cell"},
           {"a.fbx", "", "unknown kind of file"}}) {
    EXPECT_THAT(RefusalOf(c.name, c.bytes), HasSubstr(c.complaint)) << c.name;
  }
}

std::string Glb(std::uint32_t length, std::uint32_t chunk, const std::string& json) {
  std::string bytes = "glTF";
  for (const std::uint32_t word : {2u, length, chunk, 0x4E4F534Au}) {
    bytes.append(reinterpret_cast<const char*>(&word), 4);
  }
  return bytes + json;
}

TEST(SceneCommand, GltfThatLiesIsRefused) {
  const std::string json = ReadText(kScenery / "tetra.gltf");
  const auto length = static_cast<std::uint32_t>(json.size());
  EXPECT_EQ(RefusalOf("a.glb", Glb(20 + length, length, json)), "") << "one that does not";
  EXPECT_THAT(RefusalOf("a.glb", Glb(4'000'000'000u, length, json)), HasSubstr("byte 8: it says"));
  EXPECT_THAT(RefusalOf("a.glb", Glb(20 + length, 4'000'000'000u, json)),
              HasSubstr("byte 12: a chunk that is longer than the file"));
  EXPECT_THAT(RefusalOf("a.gltf", Replaced(json, "\"count\": 12", "\"count\": 1000000000")),
              HasSubstr("reaches beyond its buffer of 72 bytes"));
  EXPECT_THAT(RefusalOf("a.gltf", Replaced(json, "\"count\": 12", "\"count\": -1")),
              HasSubstr("no whole number"));
  EXPECT_THAT(RefusalOf("a.gltf", Replaced(json, "\"mesh\": 0", "\"children\": [0]")),
              HasSubstr("a circle"));
  EXPECT_THAT(RefusalOf("a.gltf", Replaced(json, "\"animations\"", "\"extensionsRequired\"")),
              HasSubstr("needs the extension"));
}

TEST(SceneCommand, TellsAndDoesNotReplace) {
  const TemporaryFolder place;
  const std::vector<std::string> arguments = {"scene", (kScenery / "older.scene").string(), "--out",
                                              "room.yaml"};
  const Outcome first = Halfstep(place.path(), arguments);
  EXPECT_EQ(first.status, 0) << first.err;
  EXPECT_EQ(first.out,
            "written: room.yaml: 2 obstacles (1 box, 1 cylinder)\n"
            "  floor: its top lies at 0: the floor\n"
            "next:    halfstep init my_walk --scene room.yaml --goal 2 0\n");
  const Outcome again = Halfstep(place.path(), arguments);
  EXPECT_EQ(again.status, kBadInput);
  EXPECT_EQ(again.err, "room.yaml: is there already (--overwrite replaces it)\n");
}

}  // namespace
}  // namespace halfstep
