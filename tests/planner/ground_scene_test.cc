// The ground that scene files say: surfaces, stairs, heightmaps, levels of meshes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "planner/ground/heightmap.h"
#include "planner/scene/scene.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Scene Parse(const std::string& text, const std::string& folder = "") {
  return ParseScene(folder + "/ground.yaml", text);
}

void ExpectSame(const Ground& a, const Ground& b) {
  ASSERT_EQ(a.Solids().size(), b.Solids().size());
  EXPECT_EQ(a.Levels(), b.Levels());
  EXPECT_EQ(a.Floor(), b.Floor());
  for (size_t i = 0; i < a.Solids().size(); ++i) {
    EXPECT_EQ(a.Solids()[i].name, b.Solids()[i].name);
    EXPECT_EQ(a.Solids()[i].polygon, b.Solids()[i].polygon);
    EXPECT_EQ(a.Solids()[i].top, b.Solids()[i].top);
    EXPECT_EQ(a.Solids()[i].bottom, b.Solids()[i].bottom);
    EXPECT_EQ(a.Solids()[i].bears, b.Solids()[i].bears);
  }
}

TEST(GroundOfScenes, WithoutSurfacesItIsFlat) {
  EXPECT_EQ(Parse("{}").ground->OnlyLevel(), (GroundLevel{0, 0.0}));
  EXPECT_EQ(Parse("{floor: level, surfaces: []}").ground->OnlyLevel(), (GroundLevel{0, 0.0}));
}

TEST(GroundOfScenes, StairsAreTheirTreadsWrittenOut) {
  const Scene stairs = Parse(R"(surfaces:
  - name: flight
    stairs: {at: {x_m: 0.14, y_m: 0.5}, rise_m: 0.15, run_m: 0.28, width_m: 2, count: 3}
)");
  const Scene treads = Parse(R"(surfaces:
  - {name: flight_1, polygon_m: [[0.14, -0.5], [0.42, -0.5], [0.42, 1.5], [0.14, 1.5]],
     height_m: 0.15}
  - {name: flight_2, polygon_m: [[0.42, -0.5], [0.7, -0.5], [0.7, 1.5], [0.42, 1.5]],
     height_m: 0.3}
  - {name: flight_3, polygon_m: [[0.7, -0.5], [0.98, -0.5], [0.98, 1.5], [0.7, 1.5]],
     height_m: 0.45, thickness_m: 0.45}
)");
  ExpectSame(*stairs.ground, *treads.ground);
  // Down again from a landing, the other way round.
  const Scene down = Parse(R"(surfaces:
  - name: flight
    stairs: {at: {x_m: 0.98, y_m: 0.5, yaw_deg: 180}, rise_m: 0.15, run_m: 0.28, width_m: 2,
             count: 3}
)");
  EXPECT_EQ(down.ground->Solids()[2].polygon.rowwise().minCoeff(), Eigen::Vector2d(0.14, -0.5));
  EXPECT_EQ(down.ground->Levels(), stairs.ground->Levels());
}

TEST(GroundOfScenes, SurfacesWrittenClockwiseAreTheSame) {
  const auto text = [](const std::string& corners) {
    return "{floor: none, surfaces: [{name: stone, polygon_m: [" + corners +
           "], height_m: -0.05, thickness_m: 0.1}]}";
  };
  const Scene clockwise = Parse(text("[0, 1], [1, 1], [1, 0], [0, 0]"));
  ExpectSame(*clockwise.ground, *Parse(text("[0, 0], [1, 0], [1, 1], [0, 1]")).ground);
  EXPECT_EQ(clockwise.ground->Solids()[0].bottom, -0.15);
}

// Two heights, one pixel between that is on neither, and floor: as the surfaces written out.
TEST(GroundOfScenes, AHeightmapIsItsSurfaces) {
  const TemporaryFolder place;
  // 10 cm a pixel, 1 mm a grey value; 3 differs from 0 by less than the tolerance.
  const std::string rows = "100 102 0 0  100 100 3 200  250 250 250 200";
  WriteText(place / "field.pgm", "P2\n# by hand\n4 3\n255\n" + rows + "\n");
  std::string bytes;
  for (const int value : {100, 102, 0, 0, 100, 100, 3, 200, 250, 250, 250, 200}) {
    bytes += static_cast<char>(value);
  }
  WriteText(place / "raw.pgm", "P5 4 3 255\n" + bytes);
  const auto text = [](const std::string& file) {
    return "surfaces: [{name: field, heightmap: {file: " + file +
           ", cell_m: 0.1, scale_m: 0.001, at: {x_m: 1}}}]";
  };
  const Scene map = Parse(text("field.pgm"), place.path().string());
  const Scene written = Parse(R"(surfaces:
  - {name: field_1, polygon_m: [[0.8, -0.05], [1, -0.05], [1, 0.15], [0.8, 0.15]], height_m: 0.102}
  - {name: field_2, polygon_m: [[1.1, -0.15], [1.2, -0.15], [1.2, 0.05], [1.1, 0.05]],
     height_m: 0.2}
  - {name: field_3, polygon_m: [[0.8, -0.15], [1.1, -0.15], [1.1, -0.05], [0.8, -0.05]],
     height_m: 0.25}
)");
  ExpectSame(*map.ground, *written.ground);
  ExpectSame(*Parse(text("raw.pgm"), place.path().string()).ground, *map.ground);
  ASSERT_EQ(map.warnings.size(), 1u);
  EXPECT_THAT(map.warnings[0],
              HasSubstr("surface field: heightmap: 9 of 12 cells lie on 3 levels"));
  ASSERT_EQ(map.files.size(), 2u);
  EXPECT_EQ(map.files[1].name, "field.pgm");
  EXPECT_NE(map.files[1].sha256, "");
}

TEST(GroundOfScenes, WhatIsOnNoLevelIsSolidAndBearsNothing) {
  GreyImage image{.width = 4, .height = 1, .pixels = {50, 50, 90, 0}, .file = {}};
  const HeightmapScale scale{.X_WM = {}, .cell = 0.08, .unit = 0.001};
  const HeightmapSurfaces made = SurfacesOf("m", image, scale, true, 0.0);
  ASSERT_EQ(made.surfaces.size(), 2u);
  EXPECT_TRUE(made.surfaces[0].bears);
  EXPECT_EQ(made.surfaces[1].height, 0.09);  // 64 cm² are no level
  EXPECT_FALSE(made.surfaces[1].bears);
}

// The same steps as PGM and as PNG of 8 and 16 bits (drawn by steps.py beside them).
TEST(GroundOfScenes, PngAndPgmAreReadAlike) {
  const std::string folder = InSources("tests/fixtures/scene");
  const auto load = [&](const std::string& file) { return LoadGreyImage(folder + "/" + file); };
  const GreyImage pgm = load("steps.pgm"), png = load("steps8.png"), deep = load("steps16.png");
  EXPECT_EQ(pgm.pixels, png.pixels);
  EXPECT_EQ(pgm.width, png.width);
  EXPECT_EQ(pgm.height, png.height);
  EXPECT_EQ(deep.white, 65535);
  ASSERT_EQ(deep.pixels.size(), pgm.pixels.size());
  for (size_t i = 0; i < pgm.pixels.size(); ++i) EXPECT_EQ(deep.pixels[i], 100 * pgm.pixels[i]);
}

TEST(GroundOfScenes, ImagesThatAreNoneAreRefused) {
  const std::string path = InSources("tests/fixtures/scene/steps8.png");
  std::ifstream file(path, std::ios::binary);
  const std::string png((std::istreambuf_iterator<char>(file)), {});
  const auto refusal = [](const std::string& bytes) -> std::string {
    try {
      (void)ParseGreyImage("a.png", bytes);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal(png), "");
  EXPECT_THAT(refusal(png.substr(0, 60)), HasSubstr("a.png: PNG: the file ends too early"));
  std::string broken = png;
  broken[45] = static_cast<char>(broken[45] ^ 1);
  EXPECT_THAT(refusal(broken), HasSubstr("a.png: PNG: "));
  std::string colour = png;
  colour[25] = 2;  // the colour type; its checksum then is wrong, too
  EXPECT_THAT(refusal(colour), HasSubstr("a.png: PNG: "));
  EXPECT_THAT(refusal("P6 1 1 255 abc"), HasSubstr("no grey PGM"));
  EXPECT_THAT(refusal("P5 2 2 255\nabc"), HasSubstr("the file ends within its pixels"));
}

// A box with a step on it, as triangles: its tops are levels, its sides stay.
TEST(GroundOfScenes, LevelsOfAMeshBearAndTheRestStaysInTheWay) {
  const TemporaryFolder place;
  WriteText(place / "steps.obj",
            "v 0 0 0.1\nv 1 0 0.1\nv 1 1 0.102\nv 0 1 0.1\n"
            "v 1 0 0.2\nv 2 0 0.2\nv 2 1 0.2\nv 1 1 0.2\n"
            "v 1 0 0.1\nv 3 0 0\nv 3 1 0\nv 4 1 0.001\n"
            "f 1 2 3\nf 1 3 4\nf 5 6 7\nf 5 7 8\nf 2 5 8\nf 10 12 11\nf 8 7 6\n");
  const Scene scene = Parse("obstacles: [{name: house, mesh: {file: steps.obj, floor: levels}}]",
                            place.path().string());
  ASSERT_EQ(scene.ground->Levels().size(), 3u);
  EXPECT_EQ(scene.ground->Levels()[1].height, 0.102);
  EXPECT_EQ(scene.ground->Levels()[2].height, 0.2);
  ASSERT_EQ(scene.ground->Solids().size(), 2u);  // two triangles each became a rectangle
  EXPECT_EQ(scene.ground->Solids()[0].polygon.cols(), 4);
  EXPECT_EQ(scene.ground->Solids()[0].name, "house_1");
  EXPECT_EQ(std::get<TriangleMesh>(scene.obstacles.at(0).shape).triangles.cols(), 2);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_THAT(scene.warnings[0],
              HasSubstr("of 7 triangles 1 are floor and 4 lie on 2 levels of 2 m²"));
  // All of it level: then nothing is in the way.
  WriteText(place / "plate.obj", "v 0 0 0.1\nv 1 0 0.1\nv 1 1 0.1\nf 1 2 3\n");
  EXPECT_TRUE(Parse("obstacles: [{name: plate, mesh: {file: plate.obj, floor: levels}}]",
                    place.path().string())
                  .obstacles.empty());
}

TEST(GroundOfScenes, ScenesThatAreShippedHaveTheLevelsThatTheyShow) {
  const auto heights = [](const std::string& name) {
    std::vector<double> all;
    const Scene scene = LoadScene(InSources("experiments/scenes/") + name + ".yaml");
    for (const GroundLevel& level : scene.ground->Levels()) all.push_back(level.height);
    return all;
  };
  EXPECT_THAT(heights("stairs_10cm"), ElementsAre(0.0, 0.1, 0.2, 0.3));
  EXPECT_THAT(heights("stairs_10cm_down"), ElementsAre(0.0, 0.1, 0.2, 0.3));
  EXPECT_THAT(heights("stairs_15cm"), ElementsAre(0.0, 0.15, 0.3, 0.45));
  EXPECT_THAT(heights("platform_15cm"), ElementsAre(0.0, 0.15));
  EXPECT_THAT(heights("stones_5cm"), ElementsAre(-0.05, 0.0, 0.05));
}

}  // namespace
}  // namespace halfstep
