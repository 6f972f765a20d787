// Commands that take runs say so when they are given an episode.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/run/exit_status.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/run_check.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace halfstep {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

TEST(EpisodeMisplaced, CommandsOfRunsNameThoseOfEpisodes) {
  const TemporaryFolder place;
  WriteText(place / "walked/manifest.json", R"({"format": 2, "kind": "episode", "name": "bar"})");
  const std::vector<std::vector<std::string>> commands = {
      {"compare", "walked", "--out", "made"},
      {"export", "walked", "--format", "csv", "--out", "made"},
      {"export", "walked", "--format", "ompl", "--out", "made"}};
  for (const std::vector<std::string>& command : commands) {
    const Outcome outcome = Halfstep(place.path(), command);
    EXPECT_EQ(outcome.status, kBadInput);
    EXPECT_EQ(outcome.err,
              "walked: is the folder of an episode (valid: a run folder; `halfstep report`, "
              "`verify` and `replay` take episodes)\n");
    EXPECT_FALSE(fs::exists(place / "made"));
  }
}

TEST(EpisodeMisplaced, CommandsOfExperimentsNameTheOneOfEpisodes) {
  const TemporaryFolder place;
  const std::string config = InSources("experiments/episodes/live_bar.yaml");
  for (const std::string command : {"run", "plan"}) {
    const Outcome outcome = Halfstep(place.path(), {command, config});
    EXPECT_EQ(outcome.status, kBadInput);
    EXPECT_THAT(outcome.err, HasSubstr("live_bar.yaml:9:1: live: this is the config of an episode "
                                       "(valid: `halfstep live` takes it)\n"));
    EXPECT_FALSE(fs::exists(place / "runs"));
  }
}

}  // namespace
}  // namespace halfstep
