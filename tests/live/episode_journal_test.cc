#include "experiments/live/episode_journal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "experiments/live/episode_reader.h"
#include "tests/live/small_episode.h"
#include "tests/temporary_folder.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

LiveConfig BarJumps() {
  LiveConfig config = SmallWorld::Get().config;
  config.live.script = {Event(1.2, "jump", "bar", {0.75, 0.1, 0.02})};
  return config;
}

Scene WithBar() {
  Scene scene;
  scene.obstacles = {Bar("bar", 0.75, 2.0)};
  return scene;
}

Place PlaceWith(const Scene& scene) {
  Place place = SmallWorld::Get().place;
  place.scene = scene;
  return place;
}

// Writes the journal of an episode until `killed` [s]; returns the record as it was then.
Episode WriteJournalUntil(double killed, EpisodeJournal* journal) {
  Episode then;
  const EpisodeHooks hooks{.on_tick =
                               [&](const EpisodeTick& tick) {
                                 if (tick.now > killed) return;
                                 journal->Write(tick);
                                 then = tick.record;
                                 then.end = tick.now;
                                 then.stopped = tick.executor.stopped();
                               },
                           .held = {},
                           .stop = {}};
  (void)Play(WithBar(), BarJumps(), hooks);
  return then;
}

// Places of half-steps are read back from those of the feet: not to the bit.
void ExpectSameRecord(const Episode& a, const Episode& b) {
  const std::vector<EpisodeTable> tables = EpisodeTables(a, {}), others = EpisodeTables(b, {});
  for (size_t i = 0; i < tables.size(); ++i) {
    if (tables[i].name == "timings") continue;
    EXPECT_EQ(tables[i].file.text, others[i].file.text);
  }
  for (size_t k = 0; k < std::min(a.walks.size(), b.walks.size()); ++k) {
    const SuperposedWalk one = a.Whole(k).Walk(), other = b.Whole(k).Walk();
    ASSERT_EQ(one.duration(), other.duration());
    for (double t = 0.0; t < one.duration(); t += 0.1) {
      EXPECT_TRUE(one.At(t).value.isApprox(other.At(t).value, 1e-12)) << k << " " << t;
    }
  }
}

TEST(EpisodeJournalTest, HoldsTheRecordAtEveryTime) {
  for (const double killed : {0.0, 1.235, 100.0}) {
    const TemporaryFolder place;
    EpisodeJournal journal(place / "one", BarJumps(), false);
    const Episode then = WriteJournalUntil(killed, &journal);
    ASSERT_EQ(journal.failure(), "");
    const Episode read =
        ReadJournal(EpisodeJournal::FolderOf(place / "one"), BarJumps(), PlaceWith(WithBar()));
    ExpectSameRecord(read, then);
    EXPECT_EQ(read.ending, EpisodeEnding::kKilled);
    EXPECT_EQ(read.end, then.end);
    EXPECT_EQ(read.waited, then.waited);
    EXPECT_EQ(read.stopped, then.stopped);
    journal.Remove();
    EXPECT_FALSE(fs::exists(EpisodeJournal::FolderOf(place / "one")));
  }
}

// The process ended in the middle of a line, and before what follows it was written.
TEST(EpisodeJournalTest, ACutLineIsLeftOut) {
  const TemporaryFolder place;
  EpisodeJournal journal(place / "one", BarJumps(), false);
  const Episode then = WriteJournalUntil(1.0, &journal);
  const fs::path folder = EpisodeJournal::FolderOf(place / "one");
  std::ofstream(folder / "obstacles.csv", std::ios::app)
      << "77,bar,0.1,0.2,0.3,1.0,0.0,0.0,0.0,0.0,0.0,2.0\n";
  std::ofstream(folder / "worlds.csv", std::ios::app) << "77,1.2";
  const Episode read = ReadJournal(folder, BarJumps(), PlaceWith(WithBar()));
  ExpectSameRecord(read, then);
}

TEST(EpisodeJournalTest, IsHeldByOneProcessAndNotForgotten) {
  const TemporaryFolder place;
  {
    const EpisodeJournal journal(place / "one", BarJumps(), false);
    EXPECT_THROW(EpisodeJournal(place / "one", BarJumps(), true), std::runtime_error);
  }
  try {
    const EpisodeJournal again(place / "one", BarJumps(), false);
    FAIL() << "the record of a killed episode was overwritten";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("halfstep recover"));
  }
  EXPECT_NO_THROW(EpisodeJournal(place / "one", BarJumps(), true));
}

TEST(EpisodeJournalTest, TheRobotWalksOnWhenNothingCanBeWritten) {
  const TemporaryFolder place;
  EpisodeJournal journal(place / "one", BarJumps(), false);
  fs::remove_all(EpisodeJournal::FolderOf(place / "one"));
  std::ofstream(EpisodeJournal::FolderOf(place / "one")) << "a file has its name now";
  (void)WriteJournalUntil(1.0, &journal);
  EXPECT_THAT(journal.failure(), testing::Not(testing::IsEmpty()));
}

}  // namespace
}  // namespace halfstep
