// Walks over levels in other programs' formats: heights are those of the ground.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "tests/experiments/child_process.h"
#include "tests/temporary_folder.h"

namespace halfstep {
namespace {

using testing::HasSubstr;

/// Numbers of the last line of a table whose columns are apart by blanks.
std::vector<double> LastLine(const std::string& text) {
  std::istringstream lines(text);
  std::string line, last;
  while (std::getline(lines, line)) last = line;
  std::istringstream in(last);
  std::vector<double> numbers;
  for (double x = 0.0; in >> x;) numbers.push_back(x);
  return numbers;
}

/// A walk up three treads of 10 cm, as planned.
class ExportedStairs : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    place_ = new TemporaryFolder;
    ASSERT_EQ(Halfstep(place_->path(), {"run", ShippedConfig("stairs_10cm"), "--out", "run",
                                        "--quiet", "--set", "smoothing.methods=[]"})
                  .status,
              kSuccess);
  }
  static void TearDownTestSuite() { delete place_; }

  static Outcome Export(const std::string& format) {
    return Halfstep(place_->path(), {"export", "run", "--quiet", "--format", format});
  }
  static std::string Text(const std::string& file) { return ReadText(*place_ / file); }

  static TemporaryFolder* place_;
};
TemporaryFolder* ExportedStairs::place_ = nullptr;

TEST_F(ExportedStairs, HrpsysGetsAZmpOnTheTreadWhereTheWaistRests) {
  ASSERT_EQ(Export("hrpsys").status, kSuccess);
  const std::vector<double> waist = LastLine(Text("run-hrpsys/raw.waist"));
  const std::vector<double> zmp = LastLine(Text("run-hrpsys/raw.zmp"));
  ASSERT_EQ(waist.size(), 7U);
  ASSERT_EQ(zmp.size(), 4U);
  EXPECT_NEAR(waist[3] + zmp[3], 0.3, 1e-12);  // a waist that does not turn
}

TEST_F(ExportedStairs, MujocoGetsTheTreads) {
  ASSERT_EQ(Export("mjcf").status, kSuccess);
  const std::string model = Text("run-mjcf/raw.xml");
  EXPECT_THAT(model, HasSubstr("name=\"solid_2\""));
  EXPECT_THAT(model, testing::Not(HasSubstr("name=\"solid_3\"")));
}

TEST_F(ExportedStairs, FootstepsKeepTheirHeightsAndStepTargetsHaveNone) {
  ASSERT_EQ(Export("footsteps").status, kSuccess);
  EXPECT_EQ(Text("run-footsteps/raw.csv"), Text("run/footsteps.csv"));
  EXPECT_THAT(Text("run-footsteps/raw.csv"), HasSubstr(",z_m,"));

  const Outcome refused = Export("humanoid_nav_msgs");
  EXPECT_EQ(refused.status, kBadInput);
  EXPECT_THAT(refused.err, HasSubstr("has no heights"));
  EXPECT_FALSE(std::filesystem::exists(*place_ / "run-humanoid_nav_msgs"));
}

}  // namespace
}  // namespace halfstep
