#include "wpg/files/point_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

using testing::HasSubstr;

std::string Refusal(const std::string& path, const std::string& bytes) {
  try {
    (void)ParsePoints(path, bytes);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

template <typename T>
std::string BytesOf(T value, bool big_endian = false) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  if (big_endian) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

void ExpectPoints(const LoadedPoints& loaded, const std::vector<Eigen::Vector3d>& expected) {
  ASSERT_EQ(loaded.points.cols(), static_cast<Eigen::Index>(expected.size()));
  for (size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(loaded.points.col(static_cast<Eigen::Index>(i)), expected[i]);
  }
}

const std::vector<Eigen::Vector3d> kTwo = {{1, 2, 3}, {-0.5, 0.25, 4}};

TEST(PointFile, PlyInTextWithOtherElementsAndProperties) {
  const LoadedPoints loaded = ParsePoints("a.ply",
                                          "ply\nformat ascii 1.0\ncomment made by hand\n"
                                          "element camera 1\nproperty float f\n"
                                          "element vertex 2\nproperty uchar red\n"
                                          "property float z\nproperty double x\nproperty float y\n"
                                          "element face 1\n"
                                          "property list uchar int vertex_indices\nend_header\n"
                                          "7\n255 3 1 2\n0 4 -0.5 0.25\n3 0 1 0\n");
  ExpectPoints(loaded, kTwo);
}

TEST(PointFile, PlyInBinaryOfBothByteOrders) {
  for (const bool big : {false, true}) {
    std::string bytes = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                        "_endian 1.0\nelement face 1\nproperty list uchar short i\n"
                        "element vertex 2\nproperty float x\nproperty double y\n"
                        "property uchar c\nproperty int z\nend_header\n";
    bytes += '\x02' + BytesOf<short>(7, big) + BytesOf<short>(8, big);
    bytes += BytesOf(1.f, big) + BytesOf(2.0, big) + "c" + BytesOf(3, big);
    bytes += BytesOf(-0.5f, big) + BytesOf(0.25, big) + "c" + BytesOf(4, big);
    ExpectPoints(ParsePoints("a.ply", bytes), kTwo);
    EXPECT_THAT(Refusal("a.ply", bytes.substr(0, bytes.size() - 1)),
                HasSubstr("the file ends within its data"));
  }
}

constexpr const char* kPcdHeader =
    "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\n"
    "WIDTH 3\nHEIGHT 1\nVIEWPOINT 9 9 9 1 0 0 0\nPOINTS 3\n";

TEST(PointFile, PlyLeavesOutWhatItMarksAsNoneToo) {
  const std::string head =
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  const LoadedPoints text =
      ParsePoints("a.ply", "ply\nformat ascii 1.0\n" + head + "1 2 3\nnan 0 NaN\n-0.5 0.25 4\n");
  ExpectPoints(text, kTwo);
  EXPECT_EQ(text.invalid, 1);
  std::string bytes = "ply\nformat binary_little_endian 1.0\n" + head;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const auto& p : std::vector<std::array<float, 3>>{{1, 2, 3}, {0, nan, 0}, {-0.5, 0.25, 4}}) {
    bytes += BytesOf(p[0]) + BytesOf(p[1]) + BytesOf(p[2]);
  }
  const LoadedPoints binary = ParsePoints("a.ply", bytes);
  ExpectPoints(binary, kTwo);
  EXPECT_EQ(binary.invalid, 1);
}

TEST(PointFile, PcdLeavesOutWhatItMarksAsNone) {
  const LoadedPoints text = ParsePoints(
      "a.pcd", std::string(kPcdHeader) + "DATA ascii\n1 2 3 7\nnan nan nan 0\n-0.5 0.25 4 7\n");
  ExpectPoints(text, kTwo);
  EXPECT_EQ(text.invalid, 1);
  std::string bytes = std::string(kPcdHeader) + "DATA binary\n";
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const auto& p : std::vector<std::array<float, 3>>{{1, 2, 3}, {nan, 0, 0}, {-0.5, 0.25, 4}}) {
    bytes += BytesOf(p[0]) + BytesOf(p[1]) + BytesOf(p[2]) + BytesOf(7);
  }
  const LoadedPoints binary = ParsePoints("a.pcd", bytes);
  ExpectPoints(binary, kTwo);
  EXPECT_EQ(binary.invalid, 1);
  EXPECT_THAT(Refusal("a.pcd", bytes.substr(0, bytes.size() - 3)),
              HasSubstr("the file ends within its data"));
}

TEST(PointFile, WhatIsNoCloudIsRefusedWithItsPlace) {
  const std::string head = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n";
  const std::string ply = head + "property float y\nproperty float z\nend_header\n";
  EXPECT_THAT(Refusal("a.las", ply), HasSubstr("another kind of file (valid: .ply, .pcd)"));
  EXPECT_THAT(Refusal("a.ply", ""), HasSubstr("a.ply:1:1: the first line is not `ply`"));
  EXPECT_THAT(Refusal("a.ply", ply + "1 2 x\n"), HasSubstr("a.ply:8:5: 'x' is not a number"));
  EXPECT_THAT(Refusal("a.ply", ply + "1 2\n"), HasSubstr("a.ply:8:4: a number is missing"));
  EXPECT_THAT(Refusal("a.ply", ply), HasSubstr("a number is missing"));
  EXPECT_THAT(Refusal("a.ply", ply + "1 2 inf\n"), HasSubstr("is not a finite coordinate"));
  EXPECT_THAT(Refusal("a.ply", ply + "1 2 nan\n"), HasSubstr("has no point"));
  EXPECT_THAT(Refusal("a.ply", head + "end_header\n1\n"), HasSubstr("one number `y`"));
  EXPECT_THAT(
      Refusal("a.ply", head + "property list uchar float y\nproperty float z\nend_header\n"),
      HasSubstr("one number `y`"));
  EXPECT_THAT(Refusal("a.ply", head), HasSubstr("the file ends within its header"));
  EXPECT_THAT(Refusal("a.ply", "ply\nformat ascii 2.0\n"), HasSubstr("a.ply:2:8: another format"));
  EXPECT_THAT(Refusal("a.ply", "ply\nelement vertex -1\n"), HasSubstr("'-1' (valid: 0"));
  EXPECT_THAT(Refusal("a.ply", "ply\nelement vertex 1\nproperty half x\n"),
              HasSubstr("a.ply:3:10: 'half' is no type"));
  EXPECT_THAT(Refusal("a.ply",
                      "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\n"
                      "property float y\nproperty float z\nend_header\n"),
              HasSubstr("has no point"));
  const std::string pcd = kPcdHeader;
  EXPECT_THAT(Refusal("a.pcd", pcd + "DATA binary_compressed\n"), HasSubstr("a.pcd:11:6: "));
  EXPECT_THAT(Refusal("a.pcd", pcd + "DATA ascii\n1 2 3 4 5\n"), HasSubstr("more numbers"));
  EXPECT_THAT(Refusal("a.pcd", "FIELDS x y\nWIDTH 1\nDATA ascii\n1 2\n"),
              HasSubstr("one number `z`"));
  EXPECT_THAT(Refusal("a.pcd", "FIELDS x y z\nDATA ascii\n"),
              HasSubstr("neither POINTS nor WIDTH"));
  EXPECT_THAT(Refusal("a.pcd", "FIELDS x y z\nSIZE 3 3 3\n"), HasSubstr("valid: 1, 2, 4 or 8"));
  EXPECT_THAT(Refusal("a.pcd", "FIELDS x y z\nSIZE 1 1 1\nPOINTS 1\nDATA binary\nabc"),
              HasSubstr("is a float of 1 bytes"));
  EXPECT_THAT(Refusal("a.pcd", "FIELDS x y z\nWIDTH 2\nHEIGHT 2\nPOINTS 3\nDATA ascii\n"),
              HasSubstr("WIDTH times HEIGHT is not POINTS"));
  EXPECT_THAT(Refusal("a.pcd", "COLOUR x\n"), HasSubstr("a.pcd:1:1: 'COLOUR' (valid: VERSION"));
}

}  // namespace
}  // namespace halfstep
