#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/wpg/yaml_test_config.h"

namespace halfstep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using yaml_test::ComplaintsAbout;

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
    {"deadline_s: 2,5",
     "c.yaml:1:13: deadline_s: not a number: '2,5' (a decimal point is needed: 2.5? valid: ≥ 0 s)"},
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
    {"steps:\n  - x_m: 0\n  - x_m: 0\n  - x_m: 0\n  - x_m: 0",
     "c.yaml:1:1: steps: 4 items (valid: 0 … 3 items)"},
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

  // Refused before the parser, which would queue them all, sees the first.
  EXPECT_THAT(ComplaintsAbout(std::string(3000, '[')),
              ElementsAre("c.yaml:1:1001: nested too deeply (valid: at most 64 levels)"));
  for (const char* opening : {"[", "{", "[a: ", "- ", "? ", "{a: "}) {
    std::string text;
    for (int i = 0; i < 3000; ++i) text += opening;
    EXPECT_THAT(ComplaintsAbout(text), ElementsAre(testing::AnyOf(HasSubstr("nested too deeply"),
                                                                  HasSubstr("broken YAML"))))
        << opening;
  }
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
  EXPECT_EQ(complaint(large), large + ": too large: 4194305 bytes (valid: at most 4 MiB)");
  EXPECT_EQ(complaint(good), "");
  ReadYaml(good, {}, [&folder](Fields& fields) { EXPECT_EQ(fields.directory(), folder.string()); });
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace halfstep
