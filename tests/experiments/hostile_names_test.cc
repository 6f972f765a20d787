// Names that would command a terminal, a shell, a spreadsheet or a page: refused with their place,
// or written so that they read back as they are.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "experiments/commands/commands.h"
#include "experiments/config/experiment_config.h"
#include "planner/scene/scene.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/parsed_csv.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {
namespace {

using nlohmann::json;
using testing::HasSubstr;
namespace fs = std::filesystem;

// A name as YAML and as XML write it, and a part of the complaint; "": it is accepted.
struct Hostile {
  std::string yaml, xml, complaint;
};
std::vector<Hostile> Names() {
  const std::string control = "a control character", formula = "for an option or a formula";
  const std::string x(101, 'x');
  return {{"<script>alert(1)<b>", "&lt;script>alert(1)&lt;b>", ""},
          {R"(a\"b'c,d;e)", "a&quot;b'c,d;e", ""},
          {"e\u0301 \u540d", "e\u0301 \u540d", ""},
          {R"(a\nb)", "a&#10;b", control},
          {R"(a\rb)", "a&#13;b", control},
          {R"(\e]0;title\a)", "&#27;]0;title", control},
          {R"(a\x9bm)", "a&#x9b;m", control},
          {R"(a\0b)", "a&#1;b", control},
          {x, x, "is too long (valid: at most 100 bytes)"},
          {"-rf", "-rf", formula},
          {"=cmd|calc!A0", "=cmd|calc!A0", formula},
          {"+1", "+1", formula},
          {"@SUM(A1)", "@SUM(A1)", formula}};
}
// What YAML's escapes in an accepted name stand for.
std::string Meant(std::string yaml) {
  const size_t escaped = yaml.find("\\\"");
  return escaped == std::string::npos ? yaml : yaml.erase(escaped, 1);
}

// Only line breaks among the control characters, and no line that never ends.
void ExpectFitForATerminal(const std::string& text) {
  std::string flat = text;
  std::replace(flat.begin(), flat.end(), '\n', ' ');
  EXPECT_EQ(FindInvalidUtf8(flat), std::string::npos) << Quote(text);
  EXPECT_FALSE(HasControlCharacter(flat)) << Quote(text);
  EXPECT_LT(text.size(), 20000u);
}

// Checks that `load` complains at a place of `file` and says `what`; that it accepts when "".
void ExpectComplaint(const std::string& file, const std::string& what,
                     const std::function<void()>& load) {
  try {
    load();
    EXPECT_EQ(what, "") << "was accepted";
  } catch (const InputError& error) {
    ASSERT_NE(what, "") << error.what();
    const std::string& complaint = error.complaints().front();
    EXPECT_THAT(complaint, HasSubstr(what));
    ASSERT_TRUE(complaint.starts_with(file)) << complaint;
    EXPECT_THAT(complaint.substr(file.size()), testing::ContainsRegex("^:[0-9]+:[0-9]+: "));
    ExpectFitForATerminal(error.what());
  }
}

const std::string kConfig =
    "robot: hrp2\nscene: none\nfootsteps: [{foot: right, x_m: 0.2, y_m: -0.105}]\n";

TEST(HostileNames, OfConfigs) {
  const TemporaryFolder place;
  std::vector<Hostile> names = Names();
  names.push_back({"../up", "", "cannot name a folder"});
  names.push_back({".hidden", "", "cannot name a folder"});
  names.push_back({"</script>", "", "cannot name a folder"});
  for (const Hostile& name : names) {
    SCOPED_TRACE(name.yaml);
    const std::string path = WriteText(place / "c.yaml", kConfig + "name: \"" + name.yaml + "\"\n");
    ExpectComplaint(path, name.complaint, [&] { LoadConfig(path, {}); });
  }
}

TEST(HostileNames, OfMethodsAndKeys) {
  const TemporaryFolder place;
  for (const Hostile& name : Names()) {
    SCOPED_TRACE(name.yaml);
    const bool control = name.complaint.find("control") != std::string::npos;
    const std::string method =
        WriteText(place / "m.yaml", kConfig + "smoothing: {methods: [\"" + name.yaml + "\"]}\n");
    ExpectComplaint(method, control ? "a control character in " : "none of the choices: ", [&] {
      LoadConfig(method, {});
    });
    const std::string key = WriteText(place / "k.yaml", kConfig + "\"" + name.yaml + "\": 1\n");
    ExpectComplaint(key, "unknown key", [&] { LoadConfig(key, {}); });
  }
}

TEST(HostileNames, OfOutputFolders) {
  const TemporaryFolder place;
  const auto run = [&](const std::string& directory) {
    WriteText(place / "in/c.yaml", kConfig + "smoothing: {methods: []}\noutput: {directory: \"" +
                                       directory + "\", period_s: 0.1}\n");
    return Halfstep(place.path(), {"run", "in/c.yaml"});
  };
  for (const std::string good : {"-rf", "=cmd", "<script>", "../up"}) {
    EXPECT_EQ(run(good).status, kSuccess) << good;
    EXPECT_TRUE(fs::exists(place / "in" / good / "manifest.json")) << good;
  }
  const Outcome control = run(R"(a\nb)");
  EXPECT_EQ(control.status, kBadInput);
  EXPECT_THAT(control.err, HasSubstr("c.yaml:5:21: output.directory: a control character"));
  const Outcome long_name = run(std::string(300, 'x'));
  EXPECT_EQ(long_name.status, kFailed);
  EXPECT_THAT(long_name.err, HasSubstr("File name too long"));
}

TEST(HostileNames, OfObstacles) {
  const TemporaryFolder place;
  std::vector<Hostile> names = Names();
  names.push_back({"../up", "", "unfit as a name"});
  for (const Hostile& name : names) {
    SCOPED_TRACE(name.yaml);
    const std::string path = WriteText(place / "s.yaml", "obstacles:\n  - {name: \"" + name.yaml +
                                                             "\", sphere: {radius_m: 0.1}}\n");
    ExpectComplaint(path, name.complaint, [&] { LoadScene(path); });
  }
}

// HRP-2 with its right hip's joint and link under another name.
std::string RenamedRobot(const TemporaryFolder& place, const Hostile& name) {
  fs::remove_all(place / "robots");
  fs::copy(InSources("wpg/robots"), place / "robots", fs::copy_options::recursive);
  const auto replace = [&](const std::string& file, const std::string& from,
                           const std::string& to) {
    std::string text = ReadText(place / "robots" / file);
    for (size_t at = text.find(from); at != std::string::npos;
         at = text.find(from, at + to.size())) {
      text.replace(at, from.size(), to);
    }
    WriteText(place / "robots" / file, text);
  };
  replace("hrp2.urdf", "\"RLEG_JOINT0\"", "\"" + name.xml + "\"");
  replace("hrp2.yaml", "  RLEG_JOINT0:", "  \"" + name.yaml + "\":");
  replace("hrp2.urdf", "\"RLEG_LINK0\"", "\"" + name.xml + " link\"");
  return (place / "robots/hrp2.yaml").string();
}

TEST(HostileNames, OfJointsAndLinks) {
  const TemporaryFolder place;
  for (const Hostile& name : Names()) {
    SCOPED_TRACE(name.xml);
    const std::string path = RenamedRobot(place, name);
    const std::string urdf = (place / "robots/hrp2.urdf").string();
    const std::string complaint = name.complaint.empty() ? "" : "link name: ";
    ExpectComplaint(urdf, complaint, [&] { LoadRobot(path); });
  }
}

TEST(HostileNames, ThatAreAcceptedReadBackFromEveryTable) {
  const TemporaryFolder place;
  const Hostile name = Names()[1];
  const std::string meant = Meant(name.yaml);
  RenamedRobot(place, name);
  WriteText(place / "s.yaml", "obstacles:\n  - {name: \"" + name.yaml +
                                  "\", box: {size_m: [0.05, 0.05, 0.05]},\n"
                                  "     pose: {xyz: [0.55, -0.1, 0.025]}}\n");
  WriteText(place / "c.yaml", "name: \"" + name.yaml +
                                  "\"\nrobot: robots/hrp2.yaml\nscene: s.yaml\n" +
                                  "footsteps: [{foot: right, x_m: 0.2, y_m: -0.105}]\n");
  const Outcome run = Halfstep(place.path(), {"run", "c.yaml", "--out", "r"});
  ASSERT_EQ(run.status, kSuccess) << run.err;
  ExpectFitForATerminal(run.out + run.err);
  EXPECT_THAT(run.out, HasSubstr(meant + ": hrp2, 2 half-steps, 1 obstacle"));
  for (const std::string& file : FilesBelow(place / "r")) {
    SCOPED_TRACE(file);
    const std::string text = ReadText(place / "r" / file);
    EXPECT_TRUE(!file.ends_with(".json") || json::accept(text));
    if (file.ends_with(".csv")) {
      EXPECT_NO_THROW(ParsedCsv{text});
    }
  }
  EXPECT_EQ(json::parse(ReadText(place / "r/manifest.json"))["name"], meant);
  const ParsedCsv trajectory(ReadText(place / "r/raw/trajectory.csv"));
  EXPECT_NO_THROW(trajectory.Number(0, "q_" + meant + "_rad"));
  const ParsedCsv certificate(ReadText(place / "r/raw/certificate.csv"));
  bool named = false;
  for (size_t row = 0; row < certificate.size(); ++row) {
    named = named || certificate.Text(row, "subject").ends_with(meant);
  }
  EXPECT_TRUE(named);
  EXPECT_EQ(LoadConfig((place / "r/config.yaml").string(), {}).name, meant);
  ASSERT_EQ(Halfstep(place.path(), {"compare", "r", "--out", "c"}).status, kSuccess);
  EXPECT_EQ(ParsedCsv(ReadText(place / "c/comparison.csv")).Text(0, "scenario"), meant);
  const Outcome verified = Halfstep(place.path(), {"verify", "r"});
  EXPECT_EQ(verified.status, kSuccess) << verified.out << verified.err;
}

TEST(HostileNames, OfArgumentsDoNotReachTheTerminal) {
  const TemporaryFolder place;
  const std::string escape = "\x1b]0;title\x07\x1b[2J\xc2\x9bm\xff";
  const std::string config = ShippedConfig("fig3_two_half_steps");
  WriteText(place / ("n" + escape + ".yaml"), "name: 1\n");
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{escape},
                                             {"run", escape},
                                             {"run", "n" + escape + ".yaml"},
                                             {"run", config, "--set", escape},
                                             {"run", config, "--set", escape + "=1"},
                                             {"run", config, "--set", "name=" + escape},
                                             {"run", config, "--out", "/dev/null/" + escape},
                                             {"run", config, escape, escape},
                                             {"list", escape},
                                             {"compare", escape + "=" + escape},
                                             {"smooth", config, "--method", escape},
                                             {"certify", escape},
                                             {"verify", escape},
                                             {"sweep", escape},
                                             {"explain-config", escape}}) {
    SCOPED_TRACE(Quote(arguments[0]));
    const Outcome outcome = Halfstep(place.path(), arguments);
    EXPECT_THAT(outcome.status, testing::AnyOf(kFailed, kBadInput));
    EXPECT_NE(outcome.err, "");
    ExpectFitForATerminal(outcome.out + outcome.err);
  }
}

TEST(HostileNames, OfDamagedRunsDoNotReachTheTerminal) {
  const TemporaryFolder place;
  ASSERT_EQ(Halfstep(place.path(), {"run", ShippedConfig("fig3_two_half_steps"), "--out", "r",
                                    "--set", "smoothing.methods=[]", "--quiet"})
                .status,
            kSuccess);
  for (const std::string file : {"manifest.json", "raw/certificate.json"}) {
    const std::string before = ReadText(place / "r" / file);
    json changed = json::parse(before);
    for (auto& [key, value] : changed.items()) {
      if (value.is_string()) value = value.get<std::string>() + "\x1b[2J";
    }
    WriteText(place / "r" / file, changed.dump());
    for (const std::string command : {"verify", "compare", "certify"}) {
      SCOPED_TRACE(file + " " + command);
      const Outcome outcome = Halfstep(place.path(), {command, "r"});
      ExpectFitForATerminal(outcome.out + outcome.err);
    }
    WriteText(place / "r" / file, before);
  }
}

}  // namespace
}  // namespace halfstep
