// Input and places that a program would hang on, run out of memory on, or overwrite: commands
// refuse them with a sentence.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "experiments/commands/commands.h"
#include "experiments/plot/canvas.h"
#include "experiments/report/report_page.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/run_check.h"
#include "tests/temporary_folder.h"

namespace halfstep {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

const std::string kShortWalk = ShippedConfig("fig3_two_half_steps");

void MakeRun(const TemporaryFolder& place, const std::string& name) {
  ASSERT_EQ(Halfstep(place.path(), {"run", kShortWalk, "--out", name, "--quiet", "--set",
                                    "output.period_s=0.1", "--set", "smoothing.methods=[]"})
                .status,
            kSuccess);
}

TEST(HostileFiles, AFifoIsRefusedWhereverAFileIsNamed) {
  const TemporaryFolder place;
  MakeRun(place, "a");
  ASSERT_EQ(mkfifo((place / "fifo").c_str(), 0600), 0);
  ASSERT_EQ(mkfifo((place / "fifo.stl").c_str(), 0600), 0);
  WriteText(place / "scene.yaml", "name: s\nobstacles: [{name: m, mesh: {file: fifo.stl}}]\n");
  const std::vector<std::vector<std::string>> commands = {
      {"run", "fifo"},
      {"bake", "fifo"},
      {"sweep", "fifo"},
      {"run", kShortWalk, "--set", "robot=" + (place / "fifo").string()},
      {"run", kShortWalk, "--set", "scene=" + (place / "fifo").string()},
      {"run", kShortWalk, "--set", "scene=" + (place / "scene.yaml").string()},
  };
  for (const std::vector<std::string>& command : commands) {
    const Outcome outcome = Halfstep(place.path(), command);
    EXPECT_EQ(outcome.status, kBadInput);
    EXPECT_THAT(outcome.err, testing::AnyOf(HasSubstr("is a pipe or a device (valid: a regular "),
                                            HasSubstr("no such robot"), HasSubstr("no such file")));
  }
  for (const std::string file : {"manifest.json", "raw/trajectory.csv", "raw/certificate.json"}) {
    fs::remove(place / "a" / file);
    ASSERT_EQ(mkfifo((place / "a" / file).c_str(), 0600), 0);
    for (const std::string command : {"verify", "export"}) {
      std::vector<std::string> words = {command, "a"};
      if (command == "export") words.insert(words.end(), {"--format", "csv"});
      EXPECT_NE(Halfstep(place.path(), words).status, kSuccess) << command << " " << file;
    }
  }
}

TEST(HostileFiles, AnEndlessTrajectoryIsRefusedByItsSize) {
  const TemporaryFolder place;
  MakeRun(place, "a");
  const fs::path trajectory = place / "a/raw/trajectory.csv";
  fs::resize_file(trajectory, std::uintmax_t{40} << 30);  // sparse
  const std::vector<std::vector<std::string>> commands = {
      {"verify", "a"}, {"certify", "a"}, {"export", "a", "--format", "csv"}};
  for (const std::vector<std::string>& command : commands) {
    const Outcome outcome = Halfstep(place.path(), command);
    EXPECT_EQ(outcome.status, kBadInput);
    EXPECT_THAT(outcome.err, HasSubstr("trajectory.csv: too large: 42949672960 bytes (valid: at "
                                       "most 1 GiB)"));
  }
}

TEST(HostileFiles, DeepJsonIsRefused) {
  const TemporaryFolder place;
  MakeRun(place, "a");
  const std::string manifest = ReadText(place / "a/manifest.json");
  const std::string deep = std::string(200'000, '[') + std::string(200'000, ']');
  std::string text = manifest;
  text.insert(text.find('{') + 1, "\"deep\": " + deep + ",");
  WriteText(place / "a/manifest.json", text);
  std::vector<std::vector<std::string>> commands = {
      {"compare", "a"}, {"certify", "a"}, {"export", "a", "--format", "ompl"}};
  if (HasReport()) commands.push_back({"report", "a"});
  for (const std::vector<std::string>& command : commands) {
    const Outcome outcome = Halfstep(place.path(), command);
    EXPECT_EQ(outcome.status, kBadInput) << command.front() << outcome.signal;
    EXPECT_THAT(outcome.err, HasSubstr("manifest.json: nests too deeply"));
  }
  WriteText(place / "a/manifest.json", manifest);
  WriteText(place / "a/raw/certificate.json", deep);
  const Outcome verify = Halfstep(place.path(), {"verify", "a"});
  EXPECT_EQ(verify.status, kBadInput);
  EXPECT_THAT(verify.err, HasSubstr("certificate.json: nests too deeply"));
}

TEST(HostileFiles, NoOutputFollowsALink) {
  const TemporaryFolder place;
  MakeRun(place, "precious");
  const std::string before = ReadText(place / "precious/manifest.json");
  fs::create_directory_symlink("precious", place / "link");
  WriteText(place / "thesis", "years of work");
  fs::create_symlink("thesis", place / "planted.html");
  std::vector<std::vector<std::string>> commands = {
      {"run", kShortWalk, "--out", "link", "--overwrite"},
      {"smooth", "precious", "--out", "link", "--overwrite"},
      {"certify", "link"},
      {"compare", "precious", "--out", "planted.html", "--overwrite"},
      {"export", "precious", "--format", "csv", "--out", "link", "--overwrite"}};
  if (HasReport()) {
    commands.push_back({"report", "precious", "--out", "planted.html", "--overwrite"});
  }
  fs::create_symlink("thesis", place / "planted.pdf");
  if (plot::WhyNoPlots().empty()) {
    commands.push_back({"plot", "precious", "planted.pdf", "--overwrite"});
  }
  for (const std::vector<std::string>& command : commands) {
    const Outcome outcome = Halfstep(place.path(), command);
    EXPECT_EQ(outcome.status, kFailed) << command.front() << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("is a link, which is not followed"));
  }
  EXPECT_TRUE(fs::is_symlink(place / "link"));
  EXPECT_TRUE(fs::is_symlink(place / "planted.html"));
  EXPECT_EQ(ReadText(place / "precious/manifest.json"), before);
  EXPECT_EQ(ReadText(place / "thesis"), "years of work");
}

}  // namespace
}  // namespace halfstep
