// `halfstep live` as a process: when it is killed, and when it is interrupted.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "experiments/live/episode_journal.h"
#include "experiments/run/exit_status.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/csv_schema_check.h"
#include "tests/live/small_files.h"
#include "tests/temporary_folder.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// The small world by the wall clock, with a bar that jumps into the way.
void WriteEpisodeFiles(const TemporaryFolder& place) {
  WriteSmallWorld(place.path(),
                  "clock: wall, "
                  "script: [{at_s: 1.2, do: jump, obstacle: bar, xyz: [0.75, 0.1, 0.02]}], ");
}

// Returns when the robot has walked for `seconds`, as its journal says.
void WaitUntilItHasWalked(const fs::path& episode, double seconds) {
  const fs::path clock = EpisodeJournal::FolderOf(episode) / "clock.csv";
  for (int tries = 0; tries < 30'000; ++tries) {
    std::ifstream file(clock);
    std::string header;
    double waited = 0.0, now = 0.0;
    char comma = 0;
    if (std::getline(file, header) && file >> waited >> comma >> now && now >= seconds) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  FAIL() << "it never walked";
}

TEST(LiveCommand, WhatAKilledEpisodeLeftVerifies) {
  const TemporaryFolder place;
  WriteEpisodeFiles(place);
  Child child({"live", "small.yaml", "--out", "one"}, {.working_directory = place.path()});
  WaitUntilItHasWalked(place / "one", 2.5);
  const Outcome held = Halfstep(place.path(), {"recover", "one"});
  EXPECT_EQ(held.status, kFailed) << held.err;
  EXPECT_THAT(held.err, HasSubstr("another process writes it"));
  child.Signal(SIGKILL);
  EXPECT_EQ(child.Wait().signal, SIGKILL);
  EXPECT_FALSE(fs::exists(place / "one"));

  const Outcome again = Halfstep(place.path(), {"live", "small.yaml", "--out", "one"});
  EXPECT_NE(again.status, kSuccess);
  EXPECT_THAT(again.err, HasSubstr("halfstep recover"));
  const Outcome recovered = Halfstep(place.path(), {"recover", "one"});
  EXPECT_EQ(recovered.status, kSuccess) << recovered.err;
  EXPECT_THAT(recovered.out, HasSubstr("recovered"));
  const Outcome verified = Halfstep(place.path(), {"verify", "one", "--verbose"});
  EXPECT_EQ(verified.status, kSuccess) << verified.out << verified.err;
  EXPECT_THAT(verified.out, HasSubstr("killed"));
  EXPECT_FALSE(fs::exists(EpisodeJournal::FolderOf(place / "one")));
  EXPECT_EQ(Halfstep(place.path(), {"recover", "one"}).status, kBadInput);
}

// The robot comes to rest first.
TEST(LiveCommand, AnInterruptedEpisodeIsWritten) {
  const TemporaryFolder place;
  WriteEpisodeFiles(place);
  Child child({"live", "small.yaml", "--out", "one"}, {.working_directory = place.path()});
  WaitUntilItHasWalked(place / "one", 1.0);
  child.Signal(SIGINT);
  const Outcome outcome = child.Wait();
  EXPECT_EQ(outcome.status, kInterrupted) << outcome.err;
  const Outcome verified = Halfstep(place.path(), {"verify", "one", "--verbose"});
  EXPECT_EQ(verified.status, kSuccess) << verified.out << verified.err;
  EXPECT_THAT(verified.out, HasSubstr("interrupted"));
  // What the columns mean is said of each table; of those of walks once, above them.
  for (const std::string& file : FilesBelow(place / "one")) {
    if (!file.ends_with(".csv")) continue;
    ExpectTheSchemaFits(place / "one" / file);
    if (!file.starts_with("walks/")) continue;
    const std::string schema = fs::path(file).stem().string() + ".schema.json";
    EXPECT_TRUE(fs::exists(place / "one/walks" / schema)) << file;
    EXPECT_FALSE(fs::exists((place / "one" / file).parent_path() / schema)) << file;
  }
  std::ifstream events(place / "one/events.csv");
  EXPECT_THAT(std::string(std::istreambuf_iterator<char>(events), {}), HasSubstr("stopped"));
  EXPECT_FALSE(fs::exists(EpisodeJournal::FolderOf(place / "one")));
}

}  // namespace
}  // namespace halfstep
