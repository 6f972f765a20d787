// A robot whose URDF has an inertia in other units: nothing is demanded of its dynamics, and every
// command, file and page that shows a certificate says so.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "experiments/commands/commands.h"
#include "experiments/report/report_page.h"
#include "tests/experiments/child_process.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

const std::string kDropped =
    ": nothing is demanded: what the waist carries has 40.6 kg and a moment of inertia of ";

class NotCoveredDoors : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    place_ = std::make_unique<TemporaryFolder>();
    fs::copy(InSources("wpg/robots"), *place_ / "robots", fs::copy_options::recursive);
    std::string urdf = ReadText(*place_ / "robots/hrp2.urdf");
    const std::string old = "ixx=\"";
    urdf.replace(urdf.find(old), old.size(), "ixx=\"1000");
    WriteText(*place_ / "robots/hrp2.urdf", urdf);
    WriteText(*place_ / "walk.yaml",
              "{name: walk, robot: robots/hrp2.yaml, scene: none,\n"
              " footsteps: [{foot: right, x_m: 0.2, y_m: -0.105}],\n"
              " smoothing: {methods: [dichotomy], dichotomy: {tolerance_s: 0.1}},\n"
              " output: {period_s: 0.05}}\n");
    const Outcome run = Call({"run", "walk.yaml", "--out", "run"});
    ASSERT_EQ(run.status, kSuccess) << run.err;
    ExpectTold(run);
  }
  static void TearDownTestSuite() { place_.reset(); }

  static Outcome Call(const std::vector<std::string>& arguments) {
    return Halfstep(place_->path(), arguments);
  }
  static void ExpectTold(const Outcome& outcome) {
    EXPECT_EQ(outcome.status, kSuccess) << outcome.err;
    for (const std::string family : {"zmp_robot", "torque", "friction"}) {
      EXPECT_THAT(outcome.out, HasSubstr(family + kDropped));
    }
    EXPECT_THAT(outcome.out, HasSubstr("joint_acceleration: nothing is demanded: "));
  }
  // The kinds in a list, in which the three families are.
  static std::set<std::string> KindsIn(const json& list) {
    std::set<std::string> kinds, families;
    for (const json& one : list) {
      kinds.insert(one.at("kind"));
      if (one.at("kind") == "family") families.insert(one.at("subject"));
      EXPECT_THAT(one.at("sentence").get<std::string>(), testing::Not(testing::IsEmpty()));
    }
    EXPECT_EQ(families,
              (std::set<std::string>{"friction", "joint_acceleration", "torque", "zmp_robot"}));
    return kinds;
  }
  static json ReadJson(const std::string& file) { return json::parse(ReadText(*place_ / file)); }

  static std::unique_ptr<TemporaryFolder> place_;
};
std::unique_ptr<TemporaryFolder> NotCoveredDoors::place_;

TEST_F(NotCoveredDoors, FilesOfARunHaveTheWholeList) {
  const json manifest = ReadJson("run/manifest.json").at("not_covered");
  EXPECT_EQ(KindsIn(manifest), (std::set<std::string>{"family", "mass", "pair"}));
  EXPECT_EQ(ReadJson("run/raw/certificate.json").at("not_covered"), manifest);
  EXPECT_EQ(ReadJson("run/dichotomy/certificate.json").at("not_covered"), manifest);
  if (!HasReport()) return;
  EXPECT_THAT(ReadText(*place_ / "run/report.html"), HasSubstr("zmp_robot" + kDropped));
}

TEST_F(NotCoveredDoors, RunAsJson) {
  const Outcome run = Call({"run", "walk.yaml", "--out", "as_json", "--json"});
  KindsIn(json::parse(run.out).at("not_covered"));
}

TEST_F(NotCoveredDoors, Smooth) { ExpectTold(Call({"smooth", "run", "--out", "smoothed"})); }

TEST_F(NotCoveredDoors, Certify) {
  fs::copy(*place_ / "run", *place_ / "certified", fs::copy_options::recursive);
  ExpectTold(Call({"certify", "certified"}));
}

TEST_F(NotCoveredDoors, Verify) {
  ExpectTold(Call({"verify", "run"}));
  ExpectTold(Call({"verify", "run", "--verbose"}));
}

TEST_F(NotCoveredDoors, Compare) {
  ExpectTold(Call({"compare", "run", "--out", "compared"}));
  KindsIn(ReadJson("compared/manifest.json").at("runs").at(0).at("not_covered"));
}

TEST_F(NotCoveredDoors, Sweep) {
  WriteText(*place_ / "sweep.yaml",
            "{config: walk.yaml, vary: [{key: half_step.via_height_m, values: [0.2, 0.25]}]}\n");
  ExpectTold(Call({"sweep", "sweep.yaml", "--jobs", "1", "--out", "swept"}));
  const json all = ReadJson("swept/not_covered.json").at("not_covered");
  KindsIn(all);
  for (const json& one : all) EXPECT_EQ(one.at("cases"), 2);
}

TEST_F(NotCoveredDoors, Plan) {
  WriteText(*place_ / "plan.yaml",
            "robot: robots/hrp2.yaml\nscene: none\n"
            "step_set: {x_min_m: 0, x_max_m: 0.2, y_min_m: -0.21, y_max_m: -0.21,\n"
            "             spacing_m: 0.2, yaws_rad: [0]}\n"
            "swept_volumes: {cell_m: 0.05, displacement_m: 0.05, cache: cache}\n"
            "planner: {unimproved_nodes: 0, max_nodes: 2000}\n"
            "smoothing: {methods: []}\ngoal: {x_m: 0.6, y_m: 0.1, radius_m: 0.05}\n");
  ExpectTold(Call({"plan", "plan.yaml"}));
  KindsIn(json::parse(Call({"plan", "plan.yaml", "--json"}).out).at("not_covered"));
}

TEST_F(NotCoveredDoors, Robot) {
  ExpectTold(Call({"robot", "robots/hrp2.urdf", "--package", "hrp2_bodies=robots/hrp2", "--out",
                   "guess.yaml"}));
}

}  // namespace
}  // namespace halfstep
