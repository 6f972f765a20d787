// The oracle against the project: a small fixed slice of its study.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/oracle/judge.h"
#include "tests/oracle/project_side.h"
#include "tests/temporary_folder.h"
#include "tests/wpg/shipped_robots.h"

namespace halfstep::oracle {
namespace {

TEST(TallyTest, ComesBackFromItsLine) {
  Tally tally;
  tally.walks = 1;
  tally.certified = 7;
  tally.instants = 123456;
  tally.families["floor"].pushed = 3;
  tally.families["floor"].disagreement = 1.0 / 3;
  EXPECT_EQ(ToLine(ToTally(ToLine(tally))), ToLine(tally));
}

// Three robots, five kinds of scenes each; the whole study: tests/oracle/README.md.
class OracleTest : public testing::TestWithParam<std::string> {
 protected:
  std::vector<SceneKind> Kinds() const {
    std::vector<SceneKind> kinds;
    const auto robot = std::find(kShippedRobots.begin(), kShippedRobots.end(), GetParam());
    for (auto k = robot - kShippedRobots.begin(); k < kNumSceneKinds; k += 3) {
      kinds.push_back(static_cast<SceneKind>(k));
    }
    return kinds;
  }
  // Of a walk that is feasible as it is drawn, or nearly: of stairs, platforms, stones, blocks.
  unsigned LevelSeed(SceneKind kind) const {
    const std::map<std::string, std::array<unsigned, kNumLevelKinds>> seeds = {
        {"hrp2", {0, 15, 18, 9}}, {"bison", {25, 4, 19, 34}}, {"wren", {26, 5, 20, 83}}};
    return 77000000u + seeds.at(GetParam()).at(static_cast<size_t>(kind) - kNumSceneKinds);
  }
  const TemporaryFolder folder_;
  const std::string path_ = WriteJudgedRobot(GetParam(), folder_.path().string());
};
INSTANTIATE_TEST_SUITE_P(Robots, OracleTest, testing::ValuesIn(kShippedRobots),
                         [](const auto& info) { return info.param; });

TEST_P(OracleTest, NoAnswerIsFalseAndFalsifiedOnesAreFound) {
  const Judge judge(path_);
  std::vector<std::string> falsehoods;
  Tally all;
  for (const SceneKind kind : Kinds()) {
    all.Add(judge.JudgeOne(kind, 77000003u + static_cast<unsigned>(kind), folder_.path().string(),
                           &falsehoods));
  }
  EXPECT_THAT(falsehoods, testing::IsEmpty());
  EXPECT_GT(all.judged, 10);
  EXPECT_GT(all.violated, 10);
  for (const std::string name : {"zmp_robot", "torque", "friction", "joint_acceleration",
                                 "double_support", "landing_speed"}) {
    EXPECT_GT(all.families[name].pushed, 1) << name;
  }
  // No family is left out; obstacles and areas may all have stood in the way.
  // The floor is flat, where this family is absent.
  const std::set<MarginFamily> may_lack = {MarginFamily::kOwn, MarginFamily::kClearance,
                                           MarginFamily::kNoStep, MarginFamily::kFoothold};
  for (const MarginFamily family : AllMarginFamilies()) {
    if (may_lack.contains(family)) continue;
    EXPECT_GT(all.families[std::string(Name(family))].statements, 0) << Name(family);
  }
  for (const auto& [name, family] : all.families) {
    EXPECT_EQ(family.found, family.falsified) << name;
    EXPECT_LT(family.disagreement, name == "clearance" ? 1e-6 : 1e-8) << name;
  }
  // Of bodies a tube eight times as wide is often within the true limit: levers are added up.
  FamilyTally tubes;
  for (const auto& [name, family] : all.tubes) {
    tubes.Add(family);
    if (name == "joint" || name == "joint_speed" || name == "zmp_robot") {
      EXPECT_EQ(family.found, family.falsified) << name;
    }
  }
  EXPECT_GT(tubes.pushed, 3);
  EXPECT_GT(tubes.found, 0);
}

// Over levels, and what an oracle that is a little wrong about them finds.
TEST_P(OracleTest, NoAnswerOverLevelsIsFalse) {
  const Judge judge(path_);
  std::vector<std::string> falsehoods;
  Tally all;
  constexpr std::array kFamilies = {MarginFamily::kZmpRobot, MarginFamily::kFloor,
                                    MarginFamily::kFoothold, MarginFamily::kFriction,
                                    MarginFamily::kTorque};
  // One or two for each robot.
  const auto robot = std::find(kShippedRobots.begin(), kShippedRobots.end(), GetParam());
  for (auto k = static_cast<size_t>(robot - kShippedRobots.begin()); k < kFamilies.size(); k += 3) {
    const MarginFamily family = kFamilies[k];
    const auto kind = LevelKind(static_cast<unsigned>(family));
    all.Add(judge.JudgeFamily(family, kind, LevelSeed(kind), folder_.path().string(), &falsehoods));
  }
  EXPECT_THAT(falsehoods, testing::IsEmpty());
  EXPECT_GT(all.judged, 0);
  for (const auto& [name, family] : all.families) {
    EXPECT_EQ(family.found, family.falsified) << name;
    EXPECT_LT(family.disagreement, 1e-8) << name;
  }
}

TEST_P(OracleTest, AnOracleThatIsWrongAboutLevelsFindsFalsehoods) {
  const std::vector<std::pair<OracleMistake, MarginFamily>> mistakes = {
      {OracleMistake::kRisersNearer, MarginFamily::kFloor},
      {OracleMistake::kEdgesNearer, MarginFamily::kFoothold},
      {OracleMistake::kTreadsHigher, MarginFamily::kFoothold},
      {OracleMistake::kTreadsLower, MarginFamily::kFoothold},
      {OracleMistake::kWaistLater, MarginFamily::kReach},
      {OracleMistake::kFlatShadows, MarginFamily::kZmpRobot},
      {OracleMistake::kFlatFriction, MarginFamily::kFriction},
      {OracleMistake::kFlatLoads, MarginFamily::kTorque}};
  ASSERT_EQ(mistakes.size() + 1, kNumOracleMistakes);
  // A few for each robot.
  int found = 0;
  const auto robot = std::find(kShippedRobots.begin(), kShippedRobots.end(), GetParam());
  for (auto k = static_cast<size_t>(robot - kShippedRobots.begin()); k < mistakes.size(); k += 3) {
    const auto& [mistake, family] = mistakes[k];
    const Judge judge(path_, mistake);
    // An answer that it calls false, or a value that is another, in a walk of one of the kinds: the
    // waist keeps its height where the first step goes up.
    std::vector<std::string> falsehoods;
    bool differs = false;
    for (unsigned of = 0; of < kNumLevelKinds && falsehoods.empty() && !differs; ++of) {
      const SceneKind kind = LevelKind(of);
      Tally tally =
          judge.JudgeFamily(family, kind, LevelSeed(kind), folder_.path().string(), &falsehoods);
      differs = tally.families[std::string(Name(family))].disagreement > 1e-4;
    }
    EXPECT_TRUE(differs || !falsehoods.empty()) << k;
    found += !falsehoods.empty();
  }
  EXPECT_GT(found, 0);
}

// An oracle that takes one foot to be heavier by a fiftieth calls true answers false.
TEST_P(OracleTest, AnOracleOfAnotherRobotFindsFalsehoods) {
  const TemporaryFolder other;
  const std::string path = WriteJudgedRobot(GetParam(), other.path().string());
  const PlainRobot plain(path);
  const std::string foot = plain.links[static_cast<size_t>(plain.legs[0].foot_link)].name;
  const std::string urdf = (other / (GetParam() + ".urdf")).string();
  std::string text = ReadText(urdf);
  const std::string mass = "<mass value=\"";
  const size_t begin = text.find(mass, text.find("<link name=\"" + foot)) + mass.size();
  const size_t end = text.find('"', begin);
  text.replace(begin, end - begin,
               std::to_string(1.02 * std::stod(text.substr(begin, end - begin))));
  std::filesystem::remove(urdf);  // a link
  WriteText(urdf, text);
  const Judge judge(path_, path, 1e-9);
  std::vector<std::string> falsehoods;
  judge.JudgeOne(SceneKind::kMoving, 77000001u, folder_.path().string(), &falsehoods);
  EXPECT_THAT(falsehoods, testing::Contains(testing::AnyOf(testing::HasSubstr("zmp_robot"),
                                                           testing::HasSubstr("torque"),
                                                           testing::HasSubstr("friction"))));
}

}  // namespace
}  // namespace halfstep::oracle
