#include "wpg/files/octomap_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/wpg/octomap_bytes.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

using testing::HasSubstr;

std::string ComplaintAbout(const std::string& path, const std::string& bytes) {
  try {
    (void)ParseOctomap(path, bytes);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

void ExpectTwoCells(const LoadedOctomap& map) {
  EXPECT_EQ(map.resolution, 0.05);
  ASSERT_EQ(map.cubes.size(), 2u);
  for (const LoadedOctomap::Cube& cube : map.cubes) {
    EXPECT_EQ(cube.size, 1);
    EXPECT_EQ(cube.lower, cube.occupied ? Eigen::Vector3i(0, 0, 0) : Eigen::Vector3i(1, 1, 1));
  }
  EXPECT_NE(map.cubes[0].occupied, map.cubes[1].occupied);
}

TEST(OctomapFile, BothKindsSayWhichCellsAreOccupiedAndFree) {
  ExpectTwoCells(ParseOctomap("map.bt", SmallBt()));
  ExpectTwoCells(ParseOctomap("map.ot", SmallOt()));
  EXPECT_EQ(ParseOctomap("map.bt", SmallBt()).file.bytes, SmallBt().size());
}

TEST(OctomapFile, ALargeLeafIsOneCube) {
  // The root's child 0 is free, child 7 occupied: half of each axis.
  const std::string data("\x01\x80", 2);
  const LoadedOctomap map = ParseOctomap("map.bt", SmallBt("3", &data));
  ASSERT_EQ(map.cubes.size(), 2u);
  EXPECT_EQ(map.cubes[0].lower, Eigen::Vector3i(-32768, -32768, -32768));
  EXPECT_EQ(map.cubes[0].size, 32768);
  EXPECT_FALSE(map.cubes[0].occupied);
  EXPECT_TRUE(map.cubes[1].occupied);
  EXPECT_EQ(map.cubes[1].lower, Eigen::Vector3i(0, 0, 0));
}

TEST(OctomapFile, WhatIsNoTreeIsRefused) {
  EXPECT_THAT(ComplaintAbout("map.pgm", SmallBt()), HasSubstr("another kind of file (valid: .bt"));
  EXPECT_THAT(ComplaintAbout("map.ot", SmallBt()),
              HasSubstr("map.ot:1:1: the first line is not `# Octomap OcTree file`"));
  EXPECT_THAT(ComplaintAbout("map.bt", "# Octomap OcTree binary file\nid ColorOcTree\n"),
              HasSubstr("map.bt:2:4: a tree of the kind 'ColorOcTree' (valid: OcTree)"));
  EXPECT_THAT(ComplaintAbout("map.bt", "# Octomap OcTree binary file\nid OcTree\nsize 3\n"),
              HasSubstr("the file ends within its header"));
  EXPECT_THAT(ComplaintAbout("map.bt", "# Octomap OcTree binary file\nid OcTree\nres 0\n"),
              HasSubstr("is no resolution"));
  EXPECT_THAT(ComplaintAbout("map.bt", SmallBt("0")), HasSubstr("nothing is known"));
  EXPECT_THAT(ComplaintAbout("map.bt", SmallBt("17")), HasSubstr("another number of nodes"));
  EXPECT_THAT(ComplaintAbout("map.bt", SmallBt("19")), HasSubstr("another number of nodes"));
  const std::string whole = SmallBt();
  EXPECT_THAT(ComplaintAbout("map.bt", whole.substr(0, whole.size() - 1)),
              HasSubstr("the file ends within its tree"));
  EXPECT_THAT(ComplaintAbout("map.bt", whole + " "), HasSubstr("the tree ends here"));
  std::string deep;
  for (int level = 0; level < 40; ++level) deep += std::string("\x03\x00", 2);
  EXPECT_THAT(ComplaintAbout("map.bt", SmallBt("41", &deep)), HasSubstr("deeper than 16 levels"));
  const std::string empty("\x00\x00", 2);
  EXPECT_THAT(ComplaintAbout("map.bt", SmallBt("1", &empty)), HasSubstr("without children"));
  EXPECT_THAT(ComplaintAbout("map.ot", SmallOt(std::numeric_limits<float>::quiet_NaN())),
              HasSubstr("not finite"));
}

}  // namespace
}  // namespace halfstep
