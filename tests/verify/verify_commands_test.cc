// An episode that was walked on command is verified; one whose record says other than its script is
// not.

#include <gmock/gmock.h>

#include <functional>

#include "tests/verify/tampered_episode.h"
#include "tests/verify/verify_mutation.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using Json = nlohmann::ordered_json;
using Table = TamperedRun::Table;

// The small episode's robot takes two footsteps that are listed, and then walks at a velocity for a
// while.
class CommandedEpisodeFolder {
 public:
  CommandedEpisodeFolder() {
    const fs::path walk = episode_.folder().parent_path();
    std::string config = kEpisodeConfig;
    config.resize(config.find("  script:\n"));
    config +=
        "  longest_s: 14\n"
        "  script:\n"
        "    - {at_s: 0, do: footsteps, footsteps: [{foot: left, x_m: 0.2, y_m: 0.105}, "
        "{foot: right, x_m: 0.2, y_m: -0.105}]}\n"
        "    - {at_s: 2, do: walk, velocity: [0.05, 0, 0]}\n"
        "    - {at_s: 6, do: walk, velocity: [0, 0, 0]}\n";
    WriteText(walk / "walk.yaml", config);
    made_ = Halfstep(walk, {"live", "walk.yaml", "--quiet", "--overwrite", "--out", "episode"});
  }
  const Outcome& made() const { return made_; }
  fs::path folder() const { return episode_.folder(); }
  Outcome Verify() const {
    episode_.Rehash();
    return episode_.Verify();
  }

 private:
  TamperedEpisode episode_;
  Outcome made_;
};

TEST(VerifyCommands, AcceptsWhatLiveWritesAndRefusesWhatIsForged) {
  const CommandedEpisodeFolder episode;
  ASSERT_EQ(episode.made().status, 0) << episode.made().err << episode.made().out;
  const Outcome good = episode.Verify();
  EXPECT_EQ(good.status, 0) << good.out << good.err;
  const std::string events = ReadText(episode.folder() / "events.csv");
  const std::string config = ReadText(episode.folder() / "config.yaml");
  const std::string manifest = ReadText(episode.folder() / "manifest.json");
  const auto expect = [&](const std::function<void()>& forge, const std::string& why) {
    forge();
    const Outcome outcome = episode.Verify();
    EXPECT_EQ(outcome.status, 3) << why;
    EXPECT_THAT(outcome.out, HasSubstr(why));
    WriteText(episode.folder() / "events.csv", events);
    WriteText(episode.folder() / "config.yaml", config);
    WriteText(episode.folder() / "manifest.json", manifest);
  };
  // A command that is not told, or was not given.
  expect(
      [&] {
        TamperedRun::EditCsv(episode.folder() / "events.csv", [](Table& table) {
          std::erase_if(table, [](const auto& row) { return row[1] == "commanded"; });
        });
      },
      "0 rows `commanded` of world 1 instead of 1");
  expect(
      [&] {
        TamperedRun::EditCsv(episode.folder() / "events.csv", [](Table& table) {
          table.push_back({"0.0", "commanded", "3", "0", "0", "walk"});
        });
      },
      "1 rows `commanded` of world 3 instead of 0");
  expect(
      [&] {
        TamperedRun::EditCsv(episode.folder() / "events.csv", [](Table& table) {
          table.push_back({"0.0", "commanded", "999", "0", "0", "walk"});
        });
      },
      "a row `commanded` of world 999, which is not there");
  // The script says it at another time; frames are taken every 0.2 s, one of them at 2 s.
  expect(
      [&] { TamperedRun::Replace(episode.folder() / "config.yaml", "at_s: 2\n", "at_s: 1.7\n"); },
      "0 rows `commanded` of world 9 instead of 1");
  // But times are rounded: one that is this instant may be just after it.
  TamperedRun::Replace(episode.folder() / "config.yaml", "at_s: 2\n", "at_s: 2.000000000001\n");
  EXPECT_EQ(episode.Verify().status, 0);
  WriteText(episode.folder() / "config.yaml", config);
  WriteText(episode.folder() / "manifest.json", manifest);
  // Footsteps that nobody commanded.
  expect([&] { TamperedRun::Replace(episode.folder() / "config.yaml", " x_m: 0.2", " x_m: 0.21"); },
         "walks/000/footsteps.csv: does not end with footsteps that had been commanded by 0 s");
  // A robot that was told to rest has not arrived.
  expect(
      [&] {
        Json json = Json::parse(ReadText(episode.folder() / "manifest.json"));
        json["ending"] = "arrived";
        WriteText(episode.folder() / "manifest.json", json.dump(2));
      },
      "the robot has not arrived: command 3 counts in place of the goal");
  EXPECT_EQ(episode.Verify().status, 0);  // all is as it was
}

}  // namespace
}  // namespace halfstep
