// An episode that `halfstep live` made is verified; with one wrong thing in its folder it is
// refused with the sentence that says so. Hashes follow, except where they are what is wrong.

#include <gmock/gmock.h>

#include <algorithm>
#include <functional>

#include "experiments/verify/verify_run.h"
#include "tests/verify/tampered_episode.h"
#include "tests/verify/verify_mutation.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;
using Json = nlohmann::ordered_json;
using Table = TamperedRun::Table;

size_t ColumnNamed(const Table& table, const std::string& name) {
  const auto& header = table.front();
  return static_cast<size_t>(std::ranges::find(header, name) - header.begin());
}

using ForgeEpisode = std::function<void(const fs::path& folder)>;

// Edits the last row of a table for which a condition on its cells holds, or the last one.
ForgeEpisode InLastRow(const std::string& file, const std::string& column,
                       const std::function<std::string(double)>& change,
                       const std::function<bool(const Table&, size_t)>& of = {}) {
  return [=](const fs::path& folder) {
    TamperedRun::EditCsv(folder / file, [&](Table& table) {
      size_t row = table.size() - 1;
      while (of && row > 1 && !of(table, row)) --row;
      std::string& cell = table[row][ColumnNamed(table, column)];
      cell = change(std::stod(cell));
    });
  };
}
std::function<std::string(double)> CellPlus(double more) {
  return [more](double x) { return Formatted("%.17g", x + more); };
}
std::function<std::string(double)> CellValue(const std::string& value) {
  return [value](double) { return value; };
}

// The row of the grant that allowed the last half-step.
std::function<bool(const Table&, size_t)> OfGrant(const std::string& grant) {
  return [grant](const Table& table, size_t row) { return table[row][0] == grant; };
}

// What the record itself says, for forgeries that need it.
Table TableOf(const fs::path& path) { return TamperedRun::Cells(ReadText(path)); }
std::string GrantOfLast(const fs::path& folder) { return TableOf(folder / "begun.csv").back()[1]; }
std::string LastWalk(const fs::path& folder) {
  return Formatted("walks/%03zu/", TableOf(folder / "plans.csv").size() - 2);
}

// Writes the tables of the last walk as a record had them that told walks whole.
void TellTheLastWalkWhole(const fs::path& folder) {
  const size_t walks = TableOf(folder / "plans.csv").size() - 1;
  Table footsteps, half_steps, overlaps;
  // `kept`: rows of the walk before, `same`: of this one's, that say the same.
  const auto follow = [](const Table& more, size_t kept, size_t same, Table* whole) {
    if (whole->empty()) whole->push_back(more[0]);
    whole->resize(1 + kept);
    whole->insert(whole->end(), more.begin() + 1 + static_cast<std::ptrdiff_t>(same), more.end());
  };
  for (size_t k = 0; k < walks; ++k) {
    const fs::path walk = folder / Formatted("walks/%03zu", k);
    const Table more = TableOf(walk / "half_steps.csv");
    const size_t first = std::stoul(more[1][0]) - 1;
    follow(more, first, 0, &half_steps);
    follow(TableOf(walk / "footsteps.csv"), first > 0 ? 2 + first / 2 : 0, first > 0 ? 2 : 0,
           &footsteps);
    follow(TableOf(walk / "overlaps.csv"), first > 0 ? first - 1 : 0, 0, &overlaps);
  }
  const fs::path last = folder / LastWalk(folder);
  TamperedRun::EditCsv(last / "half_steps.csv", [&](Table& table) { table = half_steps; });
  TamperedRun::EditCsv(last / "footsteps.csv", [&](Table& table) { table = footsteps; });
  TamperedRun::EditCsv(last / "overlaps.csv", [&](Table& table) { table = overlaps; });
}

// Adds to the numbers of rows of a table of the last walk, but for what is numbered 0.
void Renumber(const fs::path& folder, const std::string& file, int more) {
  TamperedRun::EditCsv(folder / (LastWalk(folder) + file), [&](Table& table) {
    for (size_t row = 1; row < table.size(); ++row) {
      const int number = std::stoi(table[row][0]);
      if (number > 0) table[row][0] = std::to_string(number + more);
    }
  });
}

// Edits the cell of the grant that allowed the last half-step.
ForgeEpisode InUsedGrant(const std::string& column,
                         const std::function<std::string(double)>& change) {
  return [=](const fs::path& folder) {
    InLastRow("grants.csv", column, change, OfGrant(GrantOfLast(folder)))(folder);
  };
}

// The grant that allowed the last half-step names the last world of the record.
void ByTheLastWorld(const fs::path& folder) {
  InUsedGrant("world", CellValue(TableOf(folder / "worlds.csv").back()[0]))(folder);
}

// Everywhere in a column of a table.
ForgeEpisode InAllRows(const std::string& file, const std::string& column,
                       const std::function<std::string(double)>& change) {
  return [=](const fs::path& folder) {
    TamperedRun::EditCsv(folder / file, [&](Table& table) {
      for (size_t row = 1; row < table.size(); ++row) {
        std::string& cell = table[row][ColumnNamed(table, column)];
        cell = change(std::stod(cell));
      }
    });
  };
}

struct EpisodeForgery {
  std::string name;
  ForgeEpisode before;  ///< the hashes follow
  ForgeEpisode after;   ///< they do not
  std::string reason;
};
void PrintTo(const EpisodeForgery& forgery, std::ostream* out) { *out << forgery.name; }

std::vector<EpisodeForgery> EpisodeForgeries() {
  return {
      {"ObstacleMeasuredNearer",
       InAllRows("obstacles.csv", "y_m",
                 [](double y) { return Formatted("%.17g", y > 1.2 ? y : y - 0.75); }),
       {},
       " - bar, stopped after half-step "},
      {"SpeedLowered",
       InAllRows("obstacles.csv", "speed_m_s", CellValue("0")),
       {},
       "obstacles.csv:2: speed_m_s is 0, but 0.05 by config and scene"},
      {"ErrorLowered",
       InAllRows("obstacles.csv", "error_m", CellValue("0.001")),
       {},
       "error_m is 0.001, but 0.005 by config and scene"},
      {"GrantBeforeItsWorldWasKnown", ByTheLastWorld, {}, "became known at"},
      {"GrantCountsTooLate", InUsedGrant("t_s", CellPlus(30)), {}, "but its grant counts from"},
      {"ThroughRaisedBeyondTheWalk",
       InUsedGrant("through", CellValue("99")),
       {},
       "through half-step 99, but walk"},
      {"ThroughLowered",
       InUsedGrant("through", CellValue("1")),
       {},
       "its grant reaches only through half-step 1"},
      {"ValidUntilRaised",
       InLastRow("grants.csv", "valid_until_s", CellValue("1000"), OfGrant("0")),
       {},
       "grants.csv:2: valid until 1000 s, but by the measurements of world 0 until 4 s"},
      {"BegunWithoutAGrant",
       InLastRow("begun.csv", "grant", CellValue("0")),
       {},
       "its grant is valid"},
      {"BegunByAVoidGrant",
       InLastRow("begun.csv", "grant", CellValue("0"),
                 [](const Table&, size_t row) { return row == 2; }),
       {},
       "half-step 2: its grant is against world 0, which is void since world"},
      {"BegunByNoGrantAtAll",
       InLastRow("begun.csv", "grant", CellValue("999")),
       {},
       "there is no grant 999"},
      {"HalfStepLeftOut",
       [](const fs::path& folder) {
         TamperedRun::EditCsv(folder / "begun.csv",
                              [](Table& table) { table.erase(table.begin() + 2); });
       },
       {},
       "begun.csv:3: half-step 3 instead of 2"},
      {"SuccessorChangesWhatHasBegun",
       [](const fs::path& folder) {
         TellTheLastWalkWhole(folder);
         InLastRow(LastWalk(folder) + "footsteps.csv", "x_m", CellPlus(0.01),
                   [](const Table&, size_t row) { return row == 3; })(folder);
       },
       {},
       "half-step 2 had begun before"},
      {"SuccessorGoesOnFromElsewhere",
       [](const fs::path& folder) {
         InLastRow(LastWalk(folder) + "footsteps.csv", "x_m", CellPlus(1e-8),
                   [](const Table&, size_t row) { return row == 1; })(folder);
       },
       {},
       "footsteps.csv:2: the foot does not stand there in the walk before it"},
      {"SuccessorGoesOnAtAnotherTime",
       [](const fs::path& folder) {
         InLastRow(LastWalk(folder) + "overlaps.csv", "overlap_s", CellPlus(1e-8),
                   [](const Table&, size_t row) { return row == 1; })(folder);
       },
       {},
       "half_steps.csv:2: overlap "},
      {"SuccessorGoesOnWhereNothingIs",
       [](const fs::path& folder) {
         Renumber(folder, "half_steps.csv", 40);
         Renumber(folder, "overlaps.csv", 40);
         Renumber(folder, "footsteps.csv", 20);
       },
       {},
       ", where no step of the walk before it begins or ends"},
      {"OverlapBeyondItsBound",
       [](const fs::path& folder) {
         InLastRow(LastWalk(folder) + "half_steps.csv", "start_s", CellPlus(-1.4))(folder);
       },
       {},
       "natural bound"},
      {"TrajectoryRowMoved",
       InLastRow("trajectory.csv", "com_x_m", CellPlus(0.002),
                 [](const Table&, size_t row) { return row == 100; }),
       {},
       "trajectory.csv:101: com is off the walk of half_steps.csv by 0.002"},
      {"SoundSinceLowered",
       InAllRows("worlds.csv", "sound_since", CellValue("0")),
       {},
       "sound_since is 0, but by the measured places it is"},
      {"WorldsOutOfOrder",
       [](const fs::path& folder) {
         TamperedRun::EditCsv(folder / "worlds.csv",
                              [](Table& table) { std::swap(table[2], table[3]); });
       },
       {},
       "worlds.csv:3: world 2 instead of 1"},
      {"WorldKnownBeforeItWasMeasured",
       InLastRow("worlds.csv", "known_s", CellPlus(-0.1)),
       {},
       "but measured at"},
      {"GoalMoved",
       InLastRow("worlds.csv", "goal_x_m", CellPlus(0.3)),
       {},
       "the robot has not arrived: its last stance is not in the goal of world"},
      {"EventsSayOtherwise",
       [](const fs::path& folder) {
         TamperedRun::EditCsv(folder / "events.csv", [](Table& table) {
           for (auto& row : table) {
             if (row[1] == "begins" && row[4] == "3") row[0] = "0.5";
           }
         });
       },
       {},
       "half-step 3 begins at 0.5 s, but at"},
      {"StartElsewhere",
       InLastRow("walks/000/footsteps.csv", "y_m", CellPlus(0.01),
                 [](const Table&, size_t row) { return row == 1; }),
       {},
       "walks/000/footsteps.csv:2: the walk does not start where config.yaml says"},
      {"EndsBeforeItArrives",
       [](const fs::path& folder) {
         Json json = Json::parse(ReadText(folder / "manifest.json"));
         json["end_s"] = 4.0;
         WriteText(folder / "manifest.json", json.dump(2));
       },
       {},
       "the robot has not arrived: it walks until"},
      {"NotCoveredShortened",
       [](const fs::path& folder) {
         Json json = Json::parse(ReadText(folder / "manifest.json"));
         json["not_covered"].erase(0);
         WriteText(folder / "manifest.json", json.dump(2));
       },
       {},
       "not_covered: manifest.json has "},
      {"FileMissing",
       {},
       [](const fs::path& folder) { fs::remove(folder / "timings.csv"); },
       "manifest.json lists 'timings.csv', which is not there"},
      {"FileEdited",
       {},
       [](const fs::path& folder) { TamperedRun::Replace(folder / "timings.csv", "0", "1"); },
       "timings.csv: not the one that manifest.json lists (SHA-256 differs)"},
      {"FileNotListed",
       {},
       [](const fs::path& folder) {
         Json json = Json::parse(ReadText(folder / "manifest.json"));
         json["files"].erase("walks/000/half_steps.csv");
         WriteText(folder / "manifest.json", json.dump(2));
       },
       "manifest.json does not list walks/000/half_steps.csv"},
      {"SceneChanged",
       [](const fs::path& folder) {
         TamperedRun::Replace(folder / "inputs/scene/scene.yaml", "[0.1, 0.1, 1.0]",
                              "[0.1, 0.1, 0.9]");
       },
       {},
       "scene: not the one that manifest.json is about"},
      {"LessDemandedInTheWalk",
       [](const fs::path& folder) {
         TamperedRun::EditCsv(folder / "events.csv", [](Table& table) {
           table.push_back({"0.0", "near", "0", "0", "4", "none"});
         });
       },
       {},
       "half-step 4 begins near an obstacle, but not from rest"},
      {"ClearanceDemandedLater",
       [](const fs::path& folder) {
         TamperedRun::Replace(folder / "config.yaml", "\n    clearance_m: 0.005",
                              "\n    clearance_m: 0.5");
       },
       {},
       "clearance: "},
  };
}

class ForgedEpisode : public testing::TestWithParam<EpisodeForgery> {};

TEST_P(ForgedEpisode, IsRefused) {
  const TamperedEpisode episode;
  if (GetParam().before) GetParam().before(episode.folder());
  episode.Rehash();
  if (GetParam().after) GetParam().after(episode.folder());
  const auto results = VerifyProved({.run = episode.folder().string()});
  ASSERT_EQ(results.size(), 1u);
  EXPECT_TRUE(results.front().readable) << verify::Describe(results.front());
  EXPECT_FALSE(results.front().verified);
  EXPECT_THAT(results.front().reasons, Contains(HasSubstr(GetParam().reason)))
      << verify::Describe(results.front());
}

INSTANTIATE_TEST_SUITE_P(Verify, ForgedEpisode, testing::ValuesIn(EpisodeForgeries()),
                         [](const auto& info) { return info.param.name; });

// The controls: there is something to verify, and all of it is.
TEST(VerifyEpisode, AcceptsWhatLiveWrites) {
  const TamperedEpisode episode;
  const Outcome outcome = episode.Verify();
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("\n  verified, but not where its error and speed allow, on "
                                     "which the promise rests, was "));
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr("0 contradict")));
  EXPECT_GT(TableOf(episode.folder() / "plans.csv").size(), 2u);
  EXPECT_THAT(outcome.out, HasSubstr("stop branches keep every margin"));
}

// Records that told each walk whole are read as well.
TEST(VerifyEpisode, AcceptsWalksThatAreToldWhole) {
  const TamperedEpisode episode;
  const std::string half_steps = "half_steps.csv";
  const fs::path table = episode.folder() / (LastWalk(episode.folder()) + half_steps);
  EXPECT_NE(TableOf(table)[1][0], "1") << "the last walk changes the first step";
  TellTheLastWalkWhole(episode.folder());
  EXPECT_EQ(TableOf(table)[1][0], "1");
  episode.Rehash();
  const Outcome outcome = episode.Verify();
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
}

// Where nothing is known for as long as a half-step takes, none begins, not even the first. A walk
// that begins later is proved by what was measured while the robot waited.
TEST(VerifyEpisode, AcceptsAnEpisodeThatWaits) {
  const TamperedEpisode episode;
  const auto live = [&](const std::vector<std::string>& sets) {
    std::vector<std::string> arguments = {"live", "walk.yaml", "--overwrite", "--out", "episode"};
    for (const std::string& set : sets) arguments.insert(arguments.end(), {"--set", set});
    return Halfstep(episode.folder().parent_path(), arguments);
  };
  EXPECT_EQ(
      live({"live.horizon_s=1", "live.longest_s=2", "live.sensing.rests_after_s=none"}).status, 1);
  Outcome outcome = episode.Verify();
  EXPECT_EQ(outcome.status, 0) << outcome.out;
  EXPECT_THAT(outcome.out, HasSubstr("ending: no walk"));
  EXPECT_EQ(live({"live.horizon_s=1"}).status, 0);
  outcome = episode.Verify();
  EXPECT_EQ(outcome.status, 0) << outcome.out;
  EXPECT_THAT(ReadText(episode.folder() / "worlds.csv"), HasSubstr("\n0,-1.0,-1.0,"));
}

TEST(VerifyEpisode, ExitStatusTellsWhatIsWrong) {
  const TamperedEpisode episode;
  InLastRow("worlds.csv", "goal_x_m", CellPlus(0.3))(episode.folder());
  episode.Rehash();
  const auto verify = [&] { return Halfstep(episode.folder(), {"verify", "."}); };
  EXPECT_EQ(verify().status, 3);
  TamperedRun::EditCsv(episode.folder() / "worlds.csv",
                       [](Table& table) { table.back().pop_back(); });
  episode.Rehash();
  const Outcome outcome = verify();
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("6 cells (valid: 7)"));
  EXPECT_EQ(Halfstep(episode.folder(), {"verify", ".", "--method", "raw"}).status, 2);
}

}  // namespace
}  // namespace halfstep
