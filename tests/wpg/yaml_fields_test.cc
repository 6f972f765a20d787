#include "wpg/files/yaml_fields.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/wpg/yaml_test_config.h"
#include "wpg/files/number_text.h"
#include "wpg/files/number_visit.h"

namespace halfstep {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using yaml_test::ComplaintsAbout;
using yaml_test::Config;
using yaml_test::Read;
using yaml_test::Write;

TEST(YamlFields, KeepsDefaultsOfAbsentKeys) {
  const Config config = Read("{}");
  EXPECT_EQ(config.clearance, 0.02);
  EXPECT_FALSE(config.deadline.has_value());
  EXPECT_FALSE(config.has_goal);
  EXPECT_THAT(config.methods, ElementsAre("dichotomy"));
}

TEST(YamlFields, ReadsEveryKind) {
  const Config config = Read(R"(# comment
margins: {clearance_m: +0.1, lean_deg: -30}
deadline_s: 1e-3
seed: 7
certify: false
name: "a: b"
methods: [ipopt, nlopt]
xyz: [.5, 5., -1E2]
polygon:
- [0, 1]
- [2, 3]
goal: {x_m: 3}
steps:
  - {x_m: 0.1}
  - x_m: 0.2
    side: right
)");
  EXPECT_EQ(config.clearance, 0.1);
  EXPECT_DOUBLE_EQ(config.lean, -std::numbers::pi / 6.0);
  EXPECT_EQ(config.deadline, 1e-3);
  EXPECT_EQ(config.seed, 7);
  EXPECT_FALSE(config.certify);
  EXPECT_EQ(config.name, "a: b");
  EXPECT_THAT(config.methods, ElementsAre("ipopt", "nlopt"));
  EXPECT_THAT(config.xyz, ElementsAre(0.5, 5.0, -100.0));
  EXPECT_EQ(config.polygon, (Eigen::Matrix2d() << 0, 2, 1, 3).finished());
  EXPECT_TRUE(config.has_goal);
  ASSERT_EQ(config.steps.size(), 2u);
  EXPECT_EQ(config.steps[0].side, "left");
  EXPECT_EQ(config.steps[1].x, 0.2);
  EXPECT_EQ(config.steps[1].side, "right");
}

TEST(YamlFields, ExpandsAliases) {
  const Config config = Read("steps: [&a {x_m: 0.25}, *a]");
  ASSERT_EQ(config.steps.size(), 2u);
  EXPECT_EQ(config.steps[1].x, 0.25);
}

TEST(YamlFields, ReadsByteOrderMarkAndCarriageReturns) {
  const Config config = Read("\xEF\xBB\xBFseed: 3\r\nname: abc\r\n");
  EXPECT_EQ(config.seed, 3);
  EXPECT_EQ(config.name, "abc");
}

TEST(YamlFields, ReadsNoneAsNoValue) {
  for (const char* none : {"none", "null", "~", ""}) {
    EXPECT_FALSE(Read(std::string("deadline_s: ") + none).deadline.has_value()) << none;
  }
}

TEST(YamlFields, WritesWhatItReads) {
  Config config;
  config.clearance = 0.1 + 0.2;
  config.deadline = 1e-300;
  config.seed = std::numeric_limits<int>::max();
  config.name = "\"quoted\" \\ # : é, none";
  config.methods = {};
  config.xyz = {1.0 / 3.0, -0.0, 1e22};
  config.polygon = Eigen::Matrix2Xd::Random(2, 3);
  config.has_goal = true;
  config.goal_x = 5e-324;
  config.steps = {{0.1, "left"}, {0.2, "right"}};
  const std::string text = Write(&config);
  Config again = Read(text);
  EXPECT_EQ(Write(&again), text);
  EXPECT_EQ(again.clearance, config.clearance);
  EXPECT_EQ(again.lean, config.lean);
  EXPECT_EQ(again.deadline, config.deadline);
  EXPECT_EQ(again.name, config.name);
  EXPECT_THAT(again.methods, IsEmpty());
  EXPECT_EQ(again.xyz, config.xyz);
  EXPECT_TRUE(std::signbit(again.xyz[1]));
  EXPECT_EQ(again.polygon, config.polygon);
  EXPECT_EQ(again.goal_x, config.goal_x);
  EXPECT_EQ(again.steps.size(), 2u);
}

// An empty list is no list of three numbers.
TEST(YamlFields, LeavesOutNumbersThatAreNotThere) {
  Config config;
  config.xyz = {};
  const std::string text = Write(&config);
  EXPECT_EQ(text.find("xyz"), std::string::npos);
  EXPECT_EQ(ComplaintsAbout(text), std::vector<std::string>());
}

TEST(YamlFields, WritesReadableText) {
  Config config;
  config.lean = DegreesToRadians(30);
  config.name = "no";
  config.steps = {{0.1, "left"}};
  EXPECT_EQ(Write(&config), R"(margins:
  clearance_m: 0.02
  lean_deg: 30
deadline_s: none
seed: 1
certify: true
name: "no"
side: left
methods: [dichotomy]
xyz: [0, 0, 0]
polygon: []
steps:
  - x_m: 0.1
    side: left
)");
}

TEST(YamlFields, WritingRefusesWhatReadingWould) {
  Config config;
  config.clearance = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Write(&config), std::logic_error);
  config = Config();
  config.name = "two\nlines";
  EXPECT_THROW(Write(&config), std::logic_error);
}

TEST(YamlFields, ReportsEverythingAtOnceInTheOrderOfTheText) {
  const std::string text = R"(seed: 3.5
margin: {}
margins:
  clearance_m: -0.1
  lean_deg: abc
steps:
  - side: up
  - {x_m: 2, sides: left}
  - 4
seed: 1
)";
  EXPECT_THAT(
      ComplaintsAbout(text, {{"xyz", "[1, .inf]"}, {"nmae", "x"}}),
      ElementsAre(
          "c.yaml:1:7: seed: not an integer: '3.5' (valid: an integer, 0 … 2147483647)",
          "c.yaml:2:1: margin: unknown key (did you mean 'margins'? valid: margins, deadline_s, "
          "seed, certify, name, side, methods, xyz, polygon, goal, steps)",
          "c.yaml:4:16: margins.clearance_m: -0.1 is out of range (valid: 0 … 0.5 m)",
          "c.yaml:5:13: margins.lean_deg: not a number: 'abc' (valid: -180 … 180 deg)",
          "c.yaml:7:5: steps[0].x_m: a required key is missing (valid: a finite number [m])",
          "c.yaml:7:11: steps[0].side: none of the choices: 'up' (valid: left, right)",
          "c.yaml:8:11: steps[1].x_m: a step of more than 1 m",
          "c.yaml:8:14: steps[1].sides: unknown key (did you mean 'side'? valid: x_m, side)",
          "c.yaml:9:5: steps[2]: not a map: '4' (valid: a map)",
          "c.yaml:10:1: seed: duplicate key (first given in line 1)",
          "--set xyz: 2 numbers (valid: 3 numbers)",
          "--set xyz: xyz[1]: not a finite number: '.inf' (valid: a finite number [m])",
          "--set nmae: unknown key (did you mean 'name'? valid: margins, deadline_s, seed, "
          "certify, name, side, methods, xyz, polygon, goal, steps)"));
}

TEST(YamlFields, LeavesOutWhatNobodyReads) {
  std::string text;
  for (int i = 0; i < 150; ++i) text += "key" + std::to_string(i) + ": 1\n";
  const std::vector<std::string> complaints = ComplaintsAbout(text);
  ASSERT_EQ(complaints.size(), 101u);
  EXPECT_EQ(complaints.back(), "c.yaml: 50 more complaints left out");
}

TEST(YamlFields, DeclaringAKeyTwiceIsABrokenPrecondition) {
  const auto declare = [](Fields& fields) {
    double x = 0.0;
    fields.Number("x", &x, {});
    fields.Number("x", &x, {});
  };
  EXPECT_THROW(ReadYamlText("{}", "c.yaml", "", {}, declare), std::logic_error);
}

TEST(YamlFields, ComplainsAboutAValueOnce) {
  const auto declare = [](Fields& fields) {
    double x = -1.0;
    fields.Number("x", &x, {});
    if (x < 0.0) fields.Complain("x", "negative");
    fields.Complain("", "about the whole");
  };
  try {
    ReadYamlText("x: abc", "c.yaml", "", {}, declare);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.complaints(),
                ElementsAre("c.yaml:1:1: about the whole",
                            "c.yaml:1:4: x: not a number: 'abc' (valid: a finite number)"));
  }
}

TEST(VisitNumbers, VisitsNumbersOfGroupsWithTheirPaths) {
  Config config;
  std::vector<std::string> paths;
  VisitNumbers([&config](Fields& fields) { DeclareFields(fields, &config); },
               [&paths](const std::string& path, double* value, const NumberSpec& spec) {
                 paths.push_back(path);
                 if (path == "margins.clearance_m") *value = spec.max;
               });
  EXPECT_THAT(paths, ElementsAre("margins.clearance_m", "margins.lean_deg", "goal.x_m"));
  EXPECT_EQ(config.clearance, 0.5);
  EXPECT_FALSE(config.has_goal);
}

}  // namespace
}  // namespace halfstep
