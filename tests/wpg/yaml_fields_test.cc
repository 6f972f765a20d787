#include "wpg/input/yaml_fields.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <random>

#include "wpg/input/input_error.h"
#include "wpg/input/number_text.h"
#include "wpg/input/text.h"

namespace halfstep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct Step {
  double x = 0.0;
  std::string side = "left";
};

// One key of every kind.
struct Config {
  double clearance = 0.02;
  double lean = 0.1;
  std::optional<double> deadline;
  int seed = 1;
  bool certify = true;
  std::string name = "walk";
  std::string side = "left";
  std::vector<std::string> methods{"dichotomy"};
  std::vector<double> xyz{0.0, 0.0, 0.0};
  Eigen::Matrix2Xd polygon = Eigen::Matrix2Xd::Zero(2, 0);
  bool has_goal = false;
  double goal_x = 0.0;
  std::vector<Step> steps;
};

void DeclareFields(Fields& fields, Config* config) {
  fields.Group("margins", {}, [config](Fields& margins) {
    margins.Number("clearance_m", &config->clearance, {.unit = "m", .min = 0.0, .max = 0.5});
    margins.Number("lean_deg", &config->lean, {.unit = "deg", .min = -180.0, .max = 180.0});
  });
  fields.OptionalNumber("deadline_s", &config->deadline, {.unit = "s", .min = 0.0});
  fields.Integer("seed", &config->seed, {.min = 0});
  fields.Boolean("certify", &config->certify, {});
  fields.Text("name", &config->name, {});
  fields.Text("side", &config->side, {.choices = {"left", "right"}});
  fields.Texts("methods", &config->methods, {.choices = {"dichotomy", "ipopt", "nlopt"}});
  fields.Numbers("xyz", &config->xyz, 3, {.unit = "m"});
  fields.Points("polygon", &config->polygon, {.max_items = 4}, {.unit = "m"});
  fields.OptionalGroup("goal", &config->has_goal, {}, [config](Fields& goal) {
    goal.Number("x_m", &config->goal_x, {.unit = "m", .required = true});
  });
  fields.List("steps", {.max_items = 3}, &config->steps, [](Fields& item, Step* step) {
    item.Number("x_m", &step->x, {.unit = "m", .required = true});
    item.Text("side", &step->side, {.choices = {"left", "right"}});
    if (step->x > 1.0) item.Complain("x_m", "a step of more than 1 m");
  });
}

Config Read(const std::string& text, const std::vector<YamlOverride>& overrides = {}) {
  Config config;
  ReadYamlText(text, "c.yaml", "", overrides,
               [&config](Fields& fields) { DeclareFields(fields, &config); });
  return config;
}

std::vector<std::string> ComplaintsAbout(const std::string& text,
                                         const std::vector<YamlOverride>& overrides = {}) {
  try {
    Read(text, overrides);
  } catch (const InputError& error) {
    return error.complaints();
  }
  return {};
}

std::string Write(Config* config) {
  return WriteYaml([config](Fields& fields) { DeclareFields(fields, config); });
}

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

struct Refusal {
  const char* text;
  const char* complaint;
};

class YamlRefusal : public testing::TestWithParam<Refusal> {};

TEST_P(YamlRefusal, IsTheOnlyComplaint) {
  EXPECT_THAT(ComplaintsAbout(GetParam().text), ElementsAre(GetParam().complaint));
}

const Refusal kNumbers[] = {
    {"xyz: [010, 0, 0]",
     "c.yaml:1:7: xyz[0]: not a decimal number (leading zero): '010' (valid: a finite number [m])"},
    {"xyz: [0x1F, 0, 0]", "c.yaml:1:7: xyz[0]: not a number: '0x1F' (valid: a finite number [m])"},
    {"xyz: [1_000, 0, 0]",
     "c.yaml:1:7: xyz[0]: not a number: '1_000' (valid: a finite number [m])"},
    {"xyz: [12:30, 0, 0]",
     "c.yaml:1:7: xyz[0]: not a number: '12:30' (valid: a finite number [m])"},
    {"xyz: [+-1, 0, 0]", "c.yaml:1:7: xyz[0]: not a number: '+-1' (valid: a finite number [m])"},
    {"xyz: [1 m, 0, 0]", "c.yaml:1:7: xyz[0]: not a number: '1 m' (valid: a finite number [m])"},
    {"xyz: [nan, 0, 0]",
     "c.yaml:1:7: xyz[0]: not a finite number: 'nan' (valid: a finite number [m])"},
    {"xyz: [-.INF, 0, 0]",
     "c.yaml:1:7: xyz[0]: not a finite number: '-.INF' (valid: a finite number [m])"},
    {"xyz: [1e999, 0, 0]",
     "c.yaml:1:7: xyz[0]: not a finite number: '1e999' (valid: a finite number [m])"},
    {"xyz: ['1', 0, 0]",
     "c.yaml:1:7: xyz[0]: not a number but text in quotes: '1' (valid: a finite number [m])"},
    {"xyz: [[1], 0, 0]", "c.yaml:1:7: xyz[0]: not a number: a list (valid: a finite number [m])"},
    {"xyz: 1", "c.yaml:1:6: xyz: not a list: '1' (valid: 3 numbers)"},
    {"deadline_s: -1", "c.yaml:1:13: deadline_s: -1 is out of range (valid: ≥ 0 s)"},
    {"deadline_s: 'none'",
     "c.yaml:1:13: deadline_s: not a number but text in quotes: 'none' (valid: ≥ 0 s)"},
    {"margins: {clearance_m: }",
     "c.yaml:1:11: margins.clearance_m: not a number: nothing (valid: 0 … 0.5 m)"},
    {"seed: 1e3", "c.yaml:1:7: seed: not an integer: '1e3' (valid: an integer, 0 … 2147483647)"},
    {"seed: 2147483648",
     "c.yaml:1:7: seed: 2147483648 is out of range (valid: an integer, 0 … 2147483647)"},
    {"polygon: [[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]",
     "c.yaml:1:10: polygon: 5 points (valid: 0 … 4 points)"},
    {"polygon: [[0, 0, 0]]", "c.yaml:1:11: polygon[0]: 3 numbers (valid: 2 numbers)"},
};
INSTANTIATE_TEST_SUITE_P(Numbers, YamlRefusal, testing::ValuesIn(kNumbers));

const Refusal kOthers[] = {
    {"certify: yes", "c.yaml:1:10: certify: neither true nor false: 'yes' (valid: true, false)"},
    {"certify: 'true'",
     "c.yaml:1:10: certify: neither true nor false: 'true' (valid: true, false)"},
    {"name: [a]", "c.yaml:1:7: name: not text: a list (valid: text)"},
    {"name:", "c.yaml:1:1: name: not text: nothing (valid: text)"},
    {"name: \"a\\tb\"",
     "c.yaml:1:7: name: a control character in 'a\\x09b' (valid: text of one line)"},
    {"name: \"a\\u009bb\"",
     "c.yaml:1:7: name: a control character in 'a\\xC2\\x9Bb' (valid: text of one line)"},
    {"methods: [ipopt, nlotp]",
     "c.yaml:1:18: methods[1]: none of the choices: 'nlotp' (did you mean 'nlopt'? valid: "
     "dichotomy, ipopt, nlopt)"},
    {"margins: 3", "c.yaml:1:10: margins: not a map: '3' (valid: a map)"},
    {"steps:", "c.yaml:1:1: steps: not a list: nothing (valid: 0 … 3 items)"},
    {"steps: [{x_m: 0}, {x_m: 0}, {x_m: 0}, {x_m: 0}]",
     "c.yaml:1:8: steps: 4 items (valid: 0 … 3 items)"},
    {"goal: {}", "c.yaml:1:7: goal.x_m: a required key is missing (valid: a finite number [m])"},
    {"goal:\n  y_m: 1\n  x_m: 0",
     "c.yaml:2:3: goal.y_m: unknown key (did you mean 'x_m'? valid: x_m)"},
    {"name: !!str a", "c.yaml:1:7: name: a tag: 'tag:yaml.org,2002:str' (valid: no tags)"},
    {"? [a]\n: b", "c.yaml:1:3: a key must be a word, not a list"},
    {"margins: {~: 1}", "c.yaml:1:11: margins: a key must be a word, not nothing"},
    {"<<: {name: a}",
     "c.yaml:1:1: <<: unknown key (valid: margins, deadline_s, seed, certify, name, side, "
     "methods, xyz, polygon, goal, steps)"},
};
INSTANTIATE_TEST_SUITE_P(Others, YamlRefusal, testing::ValuesIn(kOthers));

const Refusal kWithoutATree[] = {
    {"", "c.yaml:1:1: the document is empty (valid: a map of keys)"},
    {"# nothing\n", "c.yaml:1:1: the document is empty (valid: a map of keys)"},
    {"[1, 2]", "c.yaml:1:1: not a map: a list (valid: a map of keys)"},
    {"just text", "c.yaml:1:1: not a map: 'just text' (valid: a map of keys)"},
    {"seed: 1\n---\nseed: 2", "c.yaml:2:1: a second document begins here (valid: one document)"},
    {"name: [a\nseed: 1", "c.yaml:2:5: broken YAML: end of sequence flow not found"},
    {"name: *a", "c.yaml:1:7: broken YAML: the referenced anchor is not defined"},
    {"name: \xC3\x28", "c.yaml:1:7: not UTF-8 text: byte '\\xC3'"},
    {"seed: 1\nname: \xED\xA0\x80", "c.yaml:2:7: not UTF-8 text: byte '\\xED'"},
    {"steps: &a [*a]", "c.yaml:1:12: steps[0]: an alias inside the value that it stands for"},
    {"margins: &a {clearance_m: *a}",
     "c.yaml:1:27: margins.clearance_m: an alias inside the value that it stands for"},
};
INSTANTIATE_TEST_SUITE_P(WithoutATree, YamlRefusal, testing::ValuesIn(kWithoutATree));

TEST(YamlFields, RefusesANulByte) {
  EXPECT_THAT(ComplaintsAbout(std::string("seed: 1\nna\0me: x", 16)),
              ElementsAre("c.yaml:2:3: not text: a NUL byte"));
}

TEST(YamlFields, EndsOnHostileText) {
  const std::string too_much = "too much content, aliases expanded (valid: at most 200000 values)";
  std::string bomb = "a0: &a0 [x]\n";
  std::string chain = "a0: &a0 [x]\n";
  for (int i = 1; i < 100; ++i) {
    const std::string key = "a" + std::to_string(i), last = "a" + std::to_string(i - 1);
    bomb += key + ": &" + key + " [*" + last + ", *" + last + "]\n";
    chain += key + ": &" + key + " [*" + last + "]\n";
  }
  EXPECT_THAT(ComplaintsAbout(bomb), ElementsAre(HasSubstr(too_much)));
  EXPECT_THAT(ComplaintsAbout(chain), ElementsAre(HasSubstr("nested too deeply")));

  std::string long_text = "name: &a " + std::string(1 << 20, 'x') + "\nmethods: [*a";
  for (int i = 0; i < 1000; ++i) long_text += ", *a";
  EXPECT_THAT(ComplaintsAbout(long_text + "]"), ElementsAre(HasSubstr(too_much)));

  std::string anchors = "steps: ";
  for (int i = 0; i < 60; ++i) anchors += "&a" + std::to_string(i) + " [";
  for (int i = 0; i < 5000; ++i) anchors += "x,";
  anchors += std::string(60, ']');
  EXPECT_THAT(ComplaintsAbout(anchors), ElementsAre(HasSubstr(too_much)));

  for (const char* opening : {"[", "{", "[a: ", "- ", "? ", "{a: "}) {
    std::string text;
    for (int i = 0; i < 3000; ++i) text += opening;
    EXPECT_THAT(ComplaintsAbout(text), ElementsAre(testing::AnyOf(HasSubstr("nested too deeply"),
                                                                  HasSubstr("broken YAML"))))
        << opening;
  }
}

TEST(YamlFields, LeavesOutWhatNobodyReads) {
  std::string text;
  for (int i = 0; i < 150; ++i) text += "key" + std::to_string(i) + ": 1\n";
  const std::vector<std::string> complaints = ComplaintsAbout(text);
  ASSERT_EQ(complaints.size(), 101u);
  EXPECT_EQ(complaints.back(), "c.yaml: 50 more complaints left out");
}

TEST(YamlOverrides, ReplaceAndInsert) {
  const Config config =
      Read("margins: {clearance_m: 0.1}\nsteps: [{x_m: 0}, {x_m: 0}]\nxyz: [1, 2, 3]",
           {{"margins.clearance_m", "0.3"},
            {"goal.x_m", "2"},
            {"steps.1.x_m", "0.5"},
            {"xyz.2", "9"},
            {"methods", "[nlopt]"},
            {"margins.clearance_m", "0.4"}});
  EXPECT_EQ(config.clearance, 0.4);
  EXPECT_TRUE(config.has_goal);
  EXPECT_EQ(config.goal_x, 2.0);
  EXPECT_EQ(config.steps[1].x, 0.5);
  EXPECT_THAT(config.xyz, ElementsAre(1.0, 2.0, 9.0));
  EXPECT_THAT(config.methods, ElementsAre("nlopt"));
}

TEST(YamlOverrides, AreCheckedAsTheFileIs) {
  const std::string text = "name: walk\nsteps: [{x_m: 0}]";
  const auto complaints = [&text](const std::string& key, const std::string& value) {
    return ComplaintsAbout(text, {{key, value}});
  };
  EXPECT_THAT(complaints("margins.clearance_m", "abc"),
              ElementsAre("--set margins.clearance_m: not a number: 'abc' (valid: 0 … 0.5 m)"));
  EXPECT_THAT(complaints("margins", "{clearance_m: 1}"),
              ElementsAre("--set margins: margins.clearance_m: 1 is out of range (valid: 0 … "
                          "0.5 m)"));
  EXPECT_THAT(complaints("margins.clearance", "0.1"),
              ElementsAre("--set margins.clearance: unknown key (did you mean 'clearance_m'? "
                          "valid: clearance_m, lean_deg)"));
  EXPECT_THAT(complaints("mragins.clearance_m", "0.1"),
              ElementsAre(HasSubstr("--set mragins.clearance_m: mragins: unknown key (did you "
                                    "mean 'margins'?")));
  EXPECT_THAT(complaints("", "1"),
              ElementsAre("--set '': an empty key (valid: dotted keys, as smoothing.method)"));
  EXPECT_THAT(complaints("margins..x", "1"),
              ElementsAre("--set margins..x: an empty key (valid: dotted keys, as "
                          "smoothing.method)"));
  EXPECT_THAT(complaints("name.x", "1"),
              ElementsAre("--set name.x: name is 'walk', not a map or a list"));
  EXPECT_THAT(complaints("steps.1.x_m", "1"),
              ElementsAre("--set steps.1.x_m: steps has no item '1' (valid: 0 … 0)"));
  EXPECT_THAT(complaints("steps.first", "1"),
              ElementsAre("--set steps.first: steps has no item 'first' (valid: 0 … 0)"));
  EXPECT_THAT(complaints("steps.0.x_m", "3"),
              ElementsAre("--set steps.0.x_m: steps[0].x_m: a step of more than 1 m"));
  EXPECT_THAT(complaints("name", "[a"), ElementsAre(HasSubstr("--set name: broken YAML: ")));
  EXPECT_THAT(complaints("name", ""), ElementsAre("--set name: not text: nothing (valid: text)"));
}

TEST(YamlFiles, ThatCannotBeRead) {
  const auto folder = std::filesystem::temp_directory_path() /
                      ("halfstep_yaml_fields_test_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const auto complaint = [](const std::string& path) -> std::string {
    try {
      ReadYaml(path, {}, [](Fields&) {});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const std::string missing = (folder / "missing.yaml").string();
  const std::string large = (folder / "large.yaml").string();
  const std::string good = (folder / "good.yaml").string();
  std::ofstream(large) << std::string((4 << 20) + 1, '#');
  std::ofstream(good) << "{}";
  EXPECT_EQ(complaint(missing), missing + ": cannot be opened: No such file or directory");
  EXPECT_EQ(complaint(folder.string()), folder.string() + ": is a folder, not a file");
  EXPECT_EQ(complaint(large), large + ": too large (valid: at most 4 MiB)");
  EXPECT_EQ(complaint(good), "");
  ReadYaml(good, {}, [&folder](Fields& fields) { EXPECT_EQ(fields.directory(), folder.string()); });
  std::filesystem::remove_all(folder);
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

TEST(NumberText, ReadsBackEveryDouble) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    const double value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) continue;
    const NumberText number = ParseNumber(ShortestText(value));
    ASSERT_EQ(number.kind, NumberText::Kind::kNumber) << ShortestText(value);
    ASSERT_EQ(std::bit_cast<uint64_t>(number.value), std::bit_cast<uint64_t>(value));
  }
}

TEST(NumberText, ReadsBackRadiansWrittenInDegrees) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> angle(-4.0, 4.0);
  for (int i = 0; i < 20000; ++i) {
    const double radians = angle(random);
    const std::string text = ShortestDegrees(radians);
    ASSERT_EQ(DegreesToRadians(ParseNumber(text).extended), radians) << text;
  }
  for (int degrees = -360; degrees <= 360; ++degrees) {
    EXPECT_EQ(ShortestDegrees(DegreesToRadians(degrees)), std::to_string(degrees));
  }
}

TEST(NearestWord, FindsSlipsOnly) {
  const std::vector<std::string> words{"overlap_max_s", "clearance_m", "x"};
  EXPECT_EQ(NearestWord("ovrlap_max_s", words), "overlap_max_s");
  EXPECT_EQ(NearestWord("claerance_m", words), "clearance_m");
  EXPECT_EQ(NearestWord("duration_s", words), "");
  EXPECT_EQ(NearestWord("y", words), "");
  EXPECT_EQ(NearestWord("", words), "");
  EXPECT_EQ(NearestWord(std::string(1000, 'x'), words), "");
}

TEST(Quote, ShowsWhatATerminalMustNotSee) {
  EXPECT_EQ(Quote("a\x1B[2J\xFFé"), "'a\\x1B[2J\\xFFé'");
  EXPECT_EQ(Quote(std::string(100, 'x')), "'" + std::string(60, 'x') + "…'");
}

}  // namespace
}  // namespace halfstep
