// Of an episode each stretch is proved once, whatever was walked before it; what a later walk
// forges is found.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/checker/check_walk.h"
#include "experiments/checker/walk_run.h"
#include "tests/refusal_of.h"
#include "tests/verify/tampered_episode.h"
#include "tests/verify/verify_mutation.h"
#include "wpg/files/text.h"

namespace halfstep::checker {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using Table = TamperedRun::Table;

// The small episode's robot walks at velocities that change.
class CommandedEpisode {
 public:
  CommandedEpisode() {
    const fs::path place = episode_.folder().parent_path();
    std::string config = kEpisodeConfig;
    config.resize(config.find("  script:\n"));
    config +=
        "  longest_s: 16\n"
        "  script:\n"
        "    - {at_s: 0, do: walk, velocity: [0.05, 0, 0]}\n"
        "    - {at_s: 4, do: walk, velocity: [0.1, 0, 0]}\n"
        "    - {at_s: 8, do: walk, velocity: [0, 0, 0]}\n";
    WriteText(place / "walk.yaml", config);
    const Outcome made =
        Halfstep(place, {"live", "walk.yaml", "--quiet", "--overwrite", "--out", "episode"});
    if (made.status != 0) throw std::runtime_error(made.err);
  }
  fs::path folder() const { return episode_.folder(); }
  WalkRun Read() const { return ReadWalkRun(folder().string(), ""); }

 private:
  TamperedEpisode episode_;
};
const CommandedEpisode& Commanded() {
  static const CommandedEpisode episode;
  return episode;
}

WalkTables CutAfter(WalkTables tables, size_t last) {
  tables.half_steps.resize(last + 1);
  tables.starts.resize(last + 1);
  tables.footsteps.resize(last / 2 + 3);
  return tables;
}

bool Same(const Interval& a, const Interval& b) { return a.lo == b.lo && a.hi == b.hi; }
bool Same(const WalkNumbers& a, const WalkNumbers& b) {
  for (size_t k = 0; k < a.size(); ++k) {
    for (size_t i = 0; i < 4; ++i) {
      if (!Same(a[k].over[i], b[k].over[i]) || (i < 3 && !Same(a[k].at[i], b[k].at[i]))) {
        return false;
      }
    }
  }
  return true;
}

// To the bit.
TEST(CheckEpisode, CutWalksAreThoseOfCutTables) {
  const WalkRun run = Commanded().Read();
  ASSERT_GE(run.branches.size(), 8u);
  const WalkMotion whole(run.tables);
  for (const auto& [name, last, from, world] : run.branches) {
    SCOPED_TRACE(name);
    const WalkMotion of_tables(CutAfter(run.tables, last)), cut = whole.CutAfter(last, from);
    ASSERT_EQ(cut.size(), of_tables.size());
    EXPECT_LE(cut.size() - cut.first(), 8u);  // however long the walk is
    std::vector<double> knots = of_tables.knots(), known = cut.knots();
    for (std::vector<double>* all : {&knots, &known}) {
      std::erase_if(*all, [from = from](double t) { return t < from; });
    }
    ASSERT_EQ(known, knots);
    for (size_t i = 0; i + 1 < knots.size(); ++i) {
      const double middle = 0.5 * (knots[i] + knots[i + 1]);
      EXPECT_TRUE(Same(cut.On(knots[i], knots[i + 1]), of_tables.On(knots[i], knots[i + 1])));
      const WalkMotion::Flight *a = cut.FlightAt(middle), *b = of_tables.FlightAt(middle);
      ASSERT_EQ(a == nullptr, b == nullptr);
      if (a == nullptr) continue;
      EXPECT_EQ(a->side, b->side);
      EXPECT_EQ(a->lands, b->lands);
      for (const auto member :
           {&WalkMotion::Flight::begin, &WalkMotion::Flight::end, &WalkMotion::Flight::moves_from,
            &WalkMotion::Flight::moves_to, &WalkMotion::Flight::landing}) {
        EXPECT_EQ(a->*member, b->*member);
      }
    }
  }
  EXPECT_THROW((void)whole.CutAfter(whole.size(), 0.0), std::logic_error);
  EXPECT_THROW((void)whole.CutAfter(0, whole.end()), std::logic_error);
}

TEST(CheckEpisode, IsProvedByTheIntervalsOfItsBranches) {
  WalkRun run = Commanded().Read();
  run.branches.erase(run.branches.begin(), run.branches.end() - 3);
  const TrajectoryCheck check = CheckRun(run);
  EXPECT_TRUE(check.proved());
  std::int64_t intervals = 0;
  for (const auto& [name, last, from, world] : run.branches) {
    const WalkMotion motion(CutAfter(run.tables, last));
    const TrajectoryCheck branch =
        CheckWalk(motion, run.robot, *world, run.certificate, run.crouch, {}, nullptr, from);
    EXPECT_TRUE(branch.proved());
    intervals += branch.intervals;
  }
  EXPECT_EQ(check.intervals, intervals);
}

// A copy of the record, and the last of its walks that goes on from one before it, by so many
// steps.
class ForgedEpisode {
 public:
  explicit ForgedEpisode(long least_steps = 1) {
    fs::copy(Commanded().folder().parent_path().parent_path(), place_.path(),
             fs::copy_options::recursive);
    for (size_t k = 0; fs::exists(WalkPlace(k)); ++k) {
      const std::string rows = ReadText(WalkPlace(k) / "half_steps.csv");
      if (First(k) > 0 && std::ranges::count(rows, '\n') > 2 * least_steps) walk_ = k;
    }
  }
  size_t walk() const { return walk_; }
  fs::path folder() const { return place_ / "walk/episode"; }
  // Half-step that a walk's tables begin with, from 0.
  int First(size_t walk) const {
    const std::string rows = ReadText(WalkPlace(walk) / "half_steps.csv");
    return std::stoi(rows.substr(rows.find('\n') + 1)) - 1;
  }
  template <typename Edit>
  void Forge(const std::string& table, const Edit& edit) const {
    TamperedRun::EditCsv(WalkPlace(walk_) / (table + ".csv"), edit);
  }
  std::string Refused() const {
    return RefusalOf([&] { (void)ReadWalkRun(folder().string(), ""); });
  }
  // Of the walk's first step.
  bool Proved() const {
    WalkRun run = ReadWalkRun(folder().string(), "");
    const auto first = run.branches.begin() + First(walk_);
    run.branches = {first, first + 2};
    return CheckRun(run).proved();
  }

 private:
  fs::path WalkPlace(size_t walk) const { return folder() / Formatted("walks/%03zu", walk); }

  TemporaryFolder place_;
  size_t walk_ = 0;
};

void Add(double more, std::string* cell) { *cell = Formatted("%.17g", std::stod(*cell) + more); }

TEST(CheckEpisode, ChangedRowsOfLaterWalksAreFound) {
  const ForgedEpisode as_it_is;
  ASSERT_GT(as_it_is.walk(), 0u);
  EXPECT_TRUE(as_it_is.Proved());
  const ForgedEpisode farther;  // a footstep
  farther.Forge("footsteps", [](Table& rows) { Add(0.3, &rows[3][2]); });
  EXPECT_FALSE(farther.Proved());
  const ForgedEpisode shorter;  // a step
  shorter.Forge("half_steps", [](Table& rows) { rows[1][4] = rows[2][4] = "0.3"; });
  EXPECT_THAT(shorter.Refused(), HasSubstr("does not begin where overlaps.csv has it"));
  const ForgedEpisode earlier;  // an overlap
  earlier.Forge("overlaps", [](Table& rows) { Add(1e-8, &rows[1][1]); });
  EXPECT_THAT(earlier.Refused(), HasSubstr("does not begin where overlaps.csv has it"));
}

TEST(CheckEpisode, ATailThatSaysItBeginsLaterIsFound) {
  const ForgedEpisode elsewhere;
  elsewhere.Forge("footsteps", [](Table& rows) { Add(1e-8, &rows[2][3]); });
  EXPECT_THAT(elsewhere.Refused(),
              HasSubstr("/footsteps.csv:3: the foot does not stand there in the walk before it"));
  // Without its first step, of which no other table of the walk tells that it differs.
  const ForgedEpisode later(2);
  later.Forge("half_steps", [](Table& rows) { rows.erase(rows.begin() + 1, rows.begin() + 3); });
  later.Forge("overlaps", [](Table& rows) { rows.erase(rows.begin() + 1, rows.begin() + 3); });
  later.Forge("footsteps", [](Table& rows) {
    rows[rows[3][1] == "left" ? 1 : 2] = rows[3];
    for (size_t sole = 1; sole < 3; ++sole) {
      rows[sole][0] = "0";
      rows[sole][5] = rows[sole][6] = "0.0";
    }
    rows.erase(rows.begin() + 3);
  });
  EXPECT_THAT(later.Refused(),
              testing::AnyOf(HasSubstr("does not begin where a step of the walk before it does"),
                             HasSubstr("the foot does not stand there in the walk before it"),
                             HasSubstr("does not begin where overlaps.csv has it")));
}

}  // namespace
}  // namespace halfstep::checker
