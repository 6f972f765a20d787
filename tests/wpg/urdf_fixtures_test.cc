// tests/fixtures/robot: URDFs that are refused, and those that are repaired.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/places.h"
#include "wpg/files/input_error.h"
#include "wpg/robot/urdf_file.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const fs::path kFolder = InSources("tests/fixtures/robot");

std::vector<fs::path> UrdfsIn(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".urdf") files.push_back(entry.path());
  }
  return files;
}

// A file begins with a line `<!-- expect: … -->` for each thing that is to be told.
std::vector<std::string> ExpectedOf(const fs::path& path) {
  const std::string begin = "<!-- expect: ", end = " -->";
  std::vector<std::string> expected;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line) && line.starts_with(begin);) {
    expected.push_back(line.substr(begin.size(), line.size() - begin.size() - end.size()));
  }
  return expected;
}

TEST(UrdfFixtures, AreRefusedWithTheirComplaintsInSilence) {
  const std::vector<fs::path> files = UrdfsIn(kFolder);
  EXPECT_GE(files.size(), 15u);
  for (const fs::path& path : files) {
    SCOPED_TRACE(path.filename().string());
    const std::vector<std::string> expected = ExpectedOf(path);
    EXPECT_FALSE(expected.empty());
    std::vector<std::string> complaints;
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    try {
      (void)ReadUrdf(path.string());
    } catch (const InputError& error) {
      complaints = error.complaints();
    }
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(complaints.size(), expected.size()) << testing::PrintToString(complaints);
    for (size_t i = 0; i < std::min(complaints.size(), expected.size()); ++i) {
      EXPECT_THAT(complaints[i], HasSubstr(expected[i]));
      EXPECT_THAT(complaints[i], testing::ContainsRegex("\\.urdf:[0-9]+:[0-9]+: "));
    }
  }
}

// These are read all the same.
TEST(UrdfFixtures, AreRepairedWithTheirWarnings) {
  const std::vector<fs::path> files = UrdfsIn(kFolder / "repaired");
  EXPECT_EQ(files.size(), 18u);
  for (const fs::path& path : files) {
    SCOPED_TRACE(path.filename().string());
    const std::vector<std::string> expected = ExpectedOf(path);
    UrdfTree tree;
    ASSERT_NO_THROW(tree = ReadUrdf(path.string()));
    std::vector<std::string> told = tree.warnings;
    for (const UrdfJoint& joint : tree.joints) {
      told.insert(told.end(), joint.faults.begin(), joint.faults.end());
    }
    ASSERT_EQ(told.size(), expected.size()) << testing::PrintToString(told);
    for (size_t i = 0; i < told.size(); ++i) EXPECT_THAT(told[i], HasSubstr(expected[i]));
  }
}

}  // namespace
}  // namespace halfstep
