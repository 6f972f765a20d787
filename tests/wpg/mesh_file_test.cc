#include "wpg/files/mesh_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "tests/places.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::string kFolder = InSources("tests/fixtures/mesh/");

// A file with these bytes, removed again at the end.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, const std::string& bytes)
      : path_(testing::TempDir() + name) {
    std::ofstream(path_, std::ios::binary) << bytes;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

std::string Complaint(const std::string& path) {
  try {
    LoadMesh(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(MeshFile, EveryFormOfTheCubeIsTheCube) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder + "good")) {
    SCOPED_TRACE(entry.path().filename().string());
    const LoadedMesh mesh = LoadMesh(entry.path().string());
    ++files;
    const bool is_of_two = entry.path().filename().string().starts_with("cube_of_two");
    EXPECT_EQ(mesh.vertices.cols(), is_of_two ? 16 : 8);
    ASSERT_EQ(mesh.triangles.cols(), 12);
    double volume = 0;
    for (const Eigen::Vector3i& t : mesh.triangles.colwise()) {
      const Eigen::Vector3d a = mesh.vertices.col(t[0]), b = mesh.vertices.col(t[1]);
      volume += a.dot(b.cross(mesh.vertices.col(t[2]))) / 6;
    }
    EXPECT_NEAR(volume, 1, 1e-12);
  }
  EXPECT_EQ(files, 8);
}

// The nodes' transforms, the unit and the accessor's offset and stride are all applied.
TEST(MeshFile, ADaeIsPlacedByItsScene) {
  const LoadedMesh mesh = LoadMesh(kFolder + "good/cube_nodes_in_centimetres.dae");
  const Eigen::Vector3d origin = 0.01 * Eigen::Vector3d(30 + 2 * 1, -10 + 2 * 2, 5 + 2 * 3);
  EXPECT_TRUE(mesh.vertices.col(0).isApprox(origin, 1e-12)) << mesh.vertices.col(0).transpose();
  const double angle = std::numbers::pi / 6;
  const Eigen::Vector3d along(std::cos(angle), std::sin(angle), 0.0);
  EXPECT_TRUE(mesh.vertices.col(1).isApprox(origin + along, 1e-12));
}

TEST(MeshFile, ADaeSaysWhatItCallsUp) {
  std::ifstream file(kFolder + "good/cube_triangles.dae");
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  const auto up = [&](const std::string& axis) {
    const std::string asset = "<asset><up_axis>" + axis + "</up_axis></asset>";
    std::string with = text;
    with.insert(with.find('>', with.find("<COLLADA")) + 1, asset);
    return Eigen::Vector3d(ParseMesh("up.dae", with).R_ZUp * Eigen::Vector3d::Unit(axis[0] - 'X'));
  };
  for (const char* axis : {"X_UP", "Y_UP", "Z_UP"}) {
    EXPECT_EQ(up(axis), Eigen::Vector3d::UnitZ()) << axis;
  }
}

// Each bad file says in its first line (a binary one in its header) what the complaint must hold.
TEST(MeshFile, BadFilesAreRefusedWithTheirPlace) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder + "bad")) {
    const std::string path = entry.path().string();
    SCOPED_TRACE(entry.path().filename().string());
    ++files;
    std::string first_line;
    std::getline(std::ifstream(path), first_line);
    const size_t start = first_line.find("expect: ");
    ASSERT_NE(start, std::string::npos);
    std::string expected = first_line.substr(start + 8);
    expected = expected.substr(0, expected.find('\0'));
    EXPECT_THAT(Complaint(path), HasSubstr(expected));
    EXPECT_THAT(Complaint(path), StartsWith(path + ":"));
  }
  EXPECT_EQ(files, 39);
}

// No beginning of a file may crash the reader or, for STL, pass for a whole one.
TEST(MeshFile, EveryTruncationIsRefused) {
  for (const std::string name :
       {"cube_ascii.stl", "cube_binary.stl", "cube_quads.obj", "cube_nodes_in_centimetres.dae"}) {
    std::ifstream file(kFolder + "good/" + name, std::ios::binary);
    const std::string whole((std::istreambuf_iterator<char>(file)), {});
    const bool is_stl = name.ends_with(".stl");
    // The name after the last "endsolid" may be cut.
    const size_t last = name == "cube_ascii.stl" ? whole.rfind("endsolid") + 7 : whole.size() - 1;
    for (size_t length = 0; length <= last; length += 7) {
      const TemporaryFile cut("halfstep_cut_" + name, whole.substr(0, length));
      const std::string complaint = Complaint(cut.path());
      EXPECT_TRUE(!is_stl || complaint != "no complaint") << name << " cut to " << length;
    }
  }
}

TEST(MeshFile, CoordinatesAreReadInDoublePrecision) {
  const TemporaryFile file("halfstep_precise.obj",
                           "v 0.1 1e-300 1e-400\nv +1.5 0 0\nv 0 123456.789012345 0\nf 1 2 3\n");
  const LoadedMesh mesh = LoadMesh(file.path());
  EXPECT_EQ(mesh.vertices.col(0), Eigen::Vector3d(0.1, 1e-300, 0));
  EXPECT_EQ(mesh.vertices(0, 1), 1.5);
  EXPECT_EQ(mesh.vertices(1, 2), 123456.789012345);
}

TEST(MeshFile, MissingFilesAndFoldersAreRefused) {
  EXPECT_THAT(Complaint(kFolder + "none.stl"), HasSubstr("No such file"));
  std::filesystem::create_directories(testing::TempDir() + "halfstep_folder.stl");
  EXPECT_THAT(Complaint(testing::TempDir() + "halfstep_folder.stl"),
              HasSubstr("is a folder, not a file"));
  const TemporaryFile empty("halfstep_empty.obj", "");
  EXPECT_THAT(Complaint(empty.path()), HasSubstr("is empty"));
}

}  // namespace
}  // namespace halfstep
