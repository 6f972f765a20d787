#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "experiments/commands/commands.h"
#include "experiments/compare/comparison.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/run_check.h"
#include "tests/temporary_folder.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
namespace fs = std::filesystem;

MethodRecord Method(const std::string& name, double duration, double wall,
                    std::vector<IncumbentRecord> incumbents) {
  MethodRecord record;
  record.run = "run";
  record.name = name;
  record.variables = name == "raw" ? "" : "overlaps";
  record.ending = opt::Ending::kConverged;
  record.certified = true;
  record.duration = record.cost = duration;
  record.speedup = 16.0 / duration;
  record.instants = 1000.0 * wall;
  record.effort = 2.0 * wall;
  record.wall = wall;
  record.incumbents = std::move(incumbents);
  return record;
}

RunRecord Scenario(const std::string& name, std::vector<MethodRecord> methods) {
  RunRecord run;
  run.run = "runs/" + name;
  run.scenario = name;
  run.objective = "fastest";
  run.problem = "problem of " + name;
  run.half_steps = 8;
  run.methods = std::move(methods);
  run.methods.insert(run.methods.begin(), Method("raw", 16.0, 0.0, {}));
  return run;
}

// In a: `quick` ends 4 % above `good`. In b: `good` ends without a certificate.
std::vector<RunRecord> TwoScenarios() {
  MethodRecord failed = Method("good", 9.0, 3.0, {{1.0, 1000.0, 2.0, 9.0}});
  failed.certified = false;
  return {Scenario("a", {Method("quick", 10.4, 1.0, {{0.5, 500.0, 1.0, 10.4}}),
                         Method("good", 10.0, 4.0,
                                {{2.0, 2000.0, 4.0, 10.4}, {3.0, 3000.0, 6.0, 10.05}})}),
          Scenario("b", {Method("quick", 12.0, 1.0, {{0.25, 250.0, 0.5, 12.0}}), failed})};
}

TEST(Comparison, GapIsToTheBestCertifiedWalk) {
  const Comparison comparison = Compare(TwoScenarios());
  ASSERT_EQ(comparison.cases.size(), 2u);
  EXPECT_EQ(comparison.cases[0].best_method, "good");
  EXPECT_NEAR(comparison.cases[0].methods[1].gap, 0.04, 1e-12);
  EXPECT_EQ(comparison.cases[1].best_method, "quick");
  EXPECT_EQ(comparison.cases[1].methods[1].gap, 0.0);
  EXPECT_TRUE(std::isinf(comparison.cases[1].methods[2].gap));
}

TEST(Comparison, TargetsAreMetWhenTheIncumbentFirstIs) {
  const Comparison comparison = Compare(TwoScenarios());
  const ComparedMethod& quick = comparison.cases[0].methods[1];
  const ComparedMethod& good = comparison.cases[0].methods[2];
  EXPECT_FALSE(quick.reached[0]);
  EXPECT_EQ(quick.reached[1]->wall, 0.5);
  EXPECT_EQ(quick.reached[2]->wall, 1.0);
  EXPECT_EQ(good.reached[0]->wall, 3.0);
  EXPECT_EQ(good.reached[1]->effort, 4.0);
  for (const auto& reached : comparison.cases[1].methods[2].reached) {
    EXPECT_FALSE(reached) << "an uncertified walk solves nothing";
  }
}

TEST(Comparison, ProfileIsAStaircaseOfFractionsOfAllScenarios) {
  for (const ProfileCurve& curve : PerformanceProfiles(Compare(TwoScenarios()))) {
    for (size_t i = 0; i < curve.points.size(); ++i) {
      EXPECT_GE(curve.points[i].first, 1.0);
      EXPECT_LE(curve.points[i].second, 1.0);
      if (i > 0) {
        EXPECT_LE(curve.points[i - 1].first, curve.points[i].first);
        EXPECT_LE(curve.points[i - 1].second, curve.points[i].second);
      }
    }
    if (!curve.by_wall || curve.target != 1) continue;
    if (curve.method.name == "quick") {
      EXPECT_THAT(curve.points, ElementsAre(std::pair(1.0, 1.0), std::pair(4.0, 1.0)));
    } else {  // within 5 %: four times slower in a, never in b
      EXPECT_THAT(curve.points, ElementsAre(std::pair(1.0, 0.0), std::pair(4.0, 0.5)));
    }
  }
}

TEST(Comparison, FailureCountsAsTenTimesTheSlowestSuccess) {
  const std::vector<MethodMeans> means = Means(Compare(TwoScenarios()));
  ASSERT_EQ(means.size(), 2u);
  EXPECT_EQ(means[1].method.name, "good");
  EXPECT_THAT(means[1].solved, ElementsAre(1, 1, 1));
  EXPECT_EQ(means[1].certified, 1);
  EXPECT_EQ(means[1].failed(), 1);
  // In a 2 s; in b 10 · 0.25 s.
  EXPECT_NEAR(means[1].work[1].wall, std::sqrt(2.1 * 2.6) - 0.1, 1e-12);
  EXPECT_NEAR(means[1].speedup, std::sqrt(1.6 * 1.0), 1e-12);
}

TEST(Comparison, MethodThatWasNotRunFails) {
  std::vector<RunRecord> runs = TwoScenarios();
  runs[1].methods.pop_back();
  const std::vector<MethodMeans> means = Means(Compare(runs));
  EXPECT_EQ(means[1].missing, 1);
  EXPECT_EQ(means[1].cases, 2);
  EXPECT_THAT(means[1].solved, ElementsAre(1, 1, 1));
}

TEST(Comparison, OrderOfRunsChangesNoFigure) {
  std::vector<RunRecord> runs = TwoScenarios();
  const std::vector<MethodMeans> before = Means(Compare(runs));
  std::swap(runs[0], runs[1]);
  const std::vector<MethodMeans> after = Means(Compare(runs));
  for (size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(before[i].method, after[i].method);
    EXPECT_EQ(before[i].solved, after[i].solved);
    EXPECT_NEAR(before[i].work[1].wall, after[i].work[1].wall, 1e-12);
  }
}

TEST(Comparison, SameNameForAnotherProblemIsRefused) {
  std::vector<RunRecord> runs = TwoScenarios();
  runs[1].scenario = "a";
  EXPECT_THROW((void)Compare(runs), InputError);
}

TEST(Comparison, SameMethodWithOtherOptionsIsRefused) {
  std::vector<RunRecord> runs = TwoScenarios();
  runs[1] = runs[0];
  EXPECT_EQ(Compare(runs).cases[0].methods.size(), 3u) << "the same twice is once";
  runs[1].methods[1].requested = "other";
  EXPECT_THROW((void)Compare(runs), InputError);
  runs[1].methods[1].name = "new:quick";
  EXPECT_EQ(Compare(runs).cases[0].methods.size(), 4u);
}

TEST(Comparison, MethodsCompeteForTheObjectiveThatTheyPursued) {
  std::vector<RunRecord> runs = TwoScenarios();
  runs.pop_back();
  MethodRecord& good = runs[0].methods[2];
  good.objective = "safest";
  good.cost = -0.2;
  const Comparison comparison = Compare(runs);
  ASSERT_EQ(comparison.cases.size(), 2u);
  EXPECT_EQ(comparison.cases[0].best_method, "quick");
  EXPECT_EQ(comparison.cases[1].objective, "safest");
  EXPECT_EQ(*comparison.cases[1].best_cost, -0.2);
  EXPECT_TRUE(std::isnan(comparison.cases[1].methods[0].gap)) << "raw's cost is not known";
  EXPECT_EQ(comparison.cases[1].methods[1].gap, 0.0);
}

// A walk of a method that did not improve, or did not run, is another method's.
TEST(Comparison, OnlyAMethodWithAWalkOfItsOwnIsBestOrSolvesAnything) {
  for (const opt::Ending ending : opt::kEndings) {
    SCOPED_TRACE(Name(ending));
    std::vector<RunRecord> runs = {Scenario(
        "a", {Method("other", 9.0, 1.0, {{0.5, 500.0, 9.0}}), Method("good", 9.0, 2.0, {})})};
    runs[0].methods[1].ending = ending;
    const Comparison comparison = Compare(runs);
    const ComparedCase& one = comparison.cases[0];
    const bool own = HasOwnResult(ending);
    EXPECT_EQ(one.best_method, own ? "other" : "good");
    EXPECT_EQ(std::isinf(one.methods[1].gap), !own);
    for (size_t target = 0; target + 1 < kNumTargets; ++target) {
      EXPECT_EQ(one.methods[1].reached[target].has_value(), own);
    }
    EXPECT_EQ(one.methods[1].reached.back().has_value(),
              own && ending != opt::Ending::kInterrupted);
    const MethodMeans mean = Means(comparison)[0];
    EXPECT_EQ(mean.failed(), own && ending != opt::Ending::kInterrupted ? 0 : 1);
    EXPECT_EQ(mean.certified, 1);
    EXPECT_NEAR(mean.speedup, own ? 16.0 / 9.0 : 1.0, 1e-12);
    for (const ProfileCurve& curve : PerformanceProfiles(comparison)) {
      if (curve.method.name != "other" || curve.target == 2) continue;
      EXPECT_EQ(curve.points.back().second, own ? 1.0 : 0.0);
    }
  }
}

TEST(Comparison, WhereNoMethodHasAWalkOfItsOwnRawIsBest) {
  std::vector<RunRecord> runs = {Scenario("a", {Method("other", 9.0, 1.0, {})})};
  runs[0].methods[1].ending = opt::Ending::kInvalidInput;
  EXPECT_EQ(Compare(runs).cases[0].best_method, "raw");
  EXPECT_EQ(*Compare(runs).cases[0].best_cost, 16.0);
}

class CompareCommandTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    place_ = new TemporaryFolder;
    for (const std::string name : {"fig3_two_half_steps", "fig5_box"}) {
      const Outcome outcome =
          Halfstep(place_->path(), {"run", ShippedConfig(name), "--out", name, "--quiet", "--set",
                                    "smoothing.methods=[dichotomy, dichotomy/published]"});
      ASSERT_EQ(outcome.status, kSuccess) << outcome.err;
    }
  }
  static void TearDownTestSuite() {
    delete place_;
    place_ = nullptr;
  }
  // A copy of a run with a part of one file replaced.
  static std::string Damaged(const TemporaryFolder& folder, const std::string& file,
                             const std::string& from, const std::string& to) {
    fs::copy(*place_ / "fig5_box", folder / "run", fs::copy_options::recursive);
    std::string text = ReadText(folder / "run" / file);
    const size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    if (at != std::string::npos) text.replace(at, from.size(), to);
    WriteText(folder / "run" / file, text);
    return (folder / "run").string();
  }
  static TemporaryFolder* place_;
};
TemporaryFolder* CompareCommandTest::place_ = nullptr;

TEST_F(CompareCommandTest, WritesEveryTable) {
  const Outcome outcome =
      Halfstep(place_->path(), {"compare", "fig3_two_half_steps", "fig5_box", "--out", "both"});
  ASSERT_EQ(outcome.status, kSuccess) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("fig5_box, fastest, 2 half-steps; best certified: cost "));
  std::set<std::string> files = WithSchemas(
      {"anytime.csv", "comparison.csv", "manifest.json", "means.csv", "performance_profile.csv"});
  if (HasReport()) files.insert("report.html");
  EXPECT_EQ(FilesBelow(*place_ / "both"), files);
  const ParsedCsv table(ReadText(*place_ / "both/comparison.csv"));
  ASSERT_EQ(table.size(), 6u);
  double best = 1.0;
  for (size_t row = 0; row < table.size(); ++row) {
    const ParsedCsv summary(ReadText(*place_ / table.Text(row, "run") / "summary.csv"));
    EXPECT_EQ(table.Text(row, "duration_s"), summary.Text(row % 3, "duration_s"));
    EXPECT_EQ(table.Text(row, "certified"), "true");
    best = std::min(best, table.Number(row, "gap_to_best"));
  }
  EXPECT_EQ(best, 0.0);
  EXPECT_EQ(ParsedCsv(ReadText(*place_ / "both/means.csv")).size(), 2u);
  const ParsedCsv anytime(ReadText(*place_ / "both/anytime.csv"));
  EXPECT_EQ(anytime.Text(0, "duration_s"), table.Text(0, "duration_s"));
  const ParsedCsv profile(ReadText(*place_ / "both/performance_profile.csv"));
  EXPECT_EQ(profile.Text(profile.size() - 1, "gap"), "inf");
  // Once more: the same bytes.
  const std::string before = ReadText(*place_ / "both/comparison.csv");
  ASSERT_EQ(Halfstep(place_->path(), {"compare", "fig3_two_half_steps", "fig5_box", "--out", "both",
                                      "--overwrite", "--quiet"})
                .status,
            kSuccess);
  EXPECT_EQ(ReadText(*place_ / "both/comparison.csv"), before);
}

TEST_F(CompareCommandTest, LabelsTellTheSameMethodApart) {
  const Outcome outcome = Halfstep(place_->path(), {"compare", "fig5_box", "again=fig5_box"});
  ASSERT_EQ(outcome.status, kSuccess) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("again:dichotomy/published"));
}

TEST_F(CompareCommandTest, FoldersThatBeginLikeFormulasStillNameTheRun) {
  const TemporaryFolder here;
  for (const std::string name : {"=1+1", "+1", "@SUM(A1)", "-rf"}) {
    SCOPED_TRACE(name);
    fs::copy(*place_ / "fig5_box", here / name, fs::copy_options::recursive);
    const std::string out = "of" + name;
    const Outcome outcome =
        Halfstep(here.path(), {"compare", "--out", out, "--", name, "again=" + name});
    ASSERT_EQ(outcome.status, kSuccess) << outcome.err;
    const ParsedCsv table(ReadText(here / out / "comparison.csv"));
    ASSERT_EQ(table.size(), 5u);
    for (size_t row = 0; row < table.size(); ++row) {
      EXPECT_EQ(table.Text(row, "run"), "./" + name);
      EXPECT_TRUE(fs::exists(here / table.Text(row, "run") / "manifest.json"));
    }
  }
  const Outcome label = Halfstep(here.path(), {"compare", "--", "-x==1+1"});
  EXPECT_EQ(label.status, kBadInput);
  EXPECT_THAT(label.err, HasSubstr("the label '-x' is not plain"));
}

TEST_F(CompareCommandTest, NeverReplacesARun) {
  const std::string before = ReadText(*place_ / "fig5_box/manifest.json");
  const Outcome outcome =
      Halfstep(place_->path(), {"compare", "fig5_box", "--out", "fig5_box", "--overwrite"});
  EXPECT_EQ(outcome.status, kBadInput);
  EXPECT_THAT(outcome.err, HasSubstr("fig5_box is a run folder"));
  EXPECT_EQ(ReadText(*place_ / "fig5_box/manifest.json"), before);
}

TEST_F(CompareCommandTest, RefusesDamagedRunsAndWritesNothing) {
  struct Damage {
    std::string file, from, to, complaint;
  };
  for (const Damage& damage : std::vector<Damage>{
           {"summary.csv", "true", "maybe", "certified: 'maybe' (valid: true, false)"},
           {"summary.csv", "certified", "certain", "no column 'certified'"},
           {"summary.csv", "\ndichotomy,", "\n../etc,", "cannot be a method's name"},
           {"summary.csv", "\ndichotomy,", "\n=1+1,", "'=1+1' cannot be a method's name"},
           {"summary.csv", ",converged,", ",finished,",
            "summary.csv:2: status: 'finished' (valid: converged, limit, deadline, interrupted, "
            "no_improvement, not_run, invalid_input, failed)"},
           {"manifest.json", "\"name\": \"fig5_box\"", "\"name\": \"=1+1\"", "for a formula"},
           {"summary.csv", "\ndichotomy,converged,true,", "\ndichotomy,converged,true,-", "out of"},
           {"summary.csv", "\ndichotomy,", "\nraw,", "raw is not the first"},
           {"manifest.json", "\"objective\"", "\"target\"", "no 'objective'"},
           {"manifest.json", "\"name\": \"dichotomy\"", "\"name\": \"ipopt\"", "not those of summ"},
           {"manifest.json", "{", "", "is no JSON object"},
           {"dichotomy/iterates.csv", "\n1,", "\n1,0,", "cells, the header has"},
           {"raw/certificate.json", "\"demanded\"", "\"asked\"", "no 'demanded'"}}) {
    SCOPED_TRACE(damage.file + ": " + damage.to);
    const TemporaryFolder folder;
    const std::string run = Damaged(folder, damage.file, damage.from, damage.to);
    const Outcome outcome = Halfstep(folder.path(), {"compare", run, "--out", "out"});
    EXPECT_EQ(outcome.status, kBadInput);
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, HasSubstr(damage.complaint));
    EXPECT_FALSE(fs::exists(folder / "out"));
  }
  const Outcome nothing = Halfstep(place_->path(), {"compare", "nowhere", "b c=fig5_box"});
  EXPECT_EQ(nothing.status, kBadInput);
  EXPECT_THAT(nothing.err, HasSubstr("nowhere: no such run folder"));
  EXPECT_THAT(nothing.err, HasSubstr("the label 'b c' is not plain"));
}

TEST_F(CompareCommandTest, SmoothTakesTheFootstepsOfARun) {
  const TemporaryFolder here;
  fs::copy(*place_ / "fig3_two_half_steps", here / "run", fs::copy_options::recursive);
  const Outcome outcome = Halfstep(here.path(), {"smooth", "run/", "--quiet", "--method",
                                                 "dichotomy/published", "--set", "scene=none"});
  ASSERT_EQ(outcome.status, kSuccess) << outcome.err;
  CheckRunIsWhole(here / "run-smooth", {"dichotomy_published"});
  EXPECT_EQ(ReadText(here / "run-smooth/footsteps.csv"), ReadText(here / "run/footsteps.csv"));
  EXPECT_EQ(ReadText(here / "run-smooth/dichotomy_published/trajectory.csv"),
            ReadText(here / "run/dichotomy_published/trajectory.csv"));
  const Outcome unknown = Halfstep(here.path(), {"smooth", "run", "--method", "magic"});
  EXPECT_EQ(unknown.status, kBadInput);
  EXPECT_THAT(unknown.err, HasSubstr("--method 'magic': no such method (valid: dichotomy, "));
  const Outcome goal = Halfstep(here.path(), {"smooth", ShippedConfig("island")});
  EXPECT_EQ(goal.status, kBadInput);
  EXPECT_THAT(goal.err, HasSubstr("there are no footsteps to smooth"));
}

TEST_F(CompareCommandTest, CertifyMakesTheSameCertificatesAnew) {
  const TemporaryFolder here;
  fs::copy(*place_ / "fig5_box", here / "run", fs::copy_options::recursive);
  const std::string certificate = "run/dichotomy/certificate.csv";
  const std::string before = ReadText(here / certificate);
  WriteText(here / certificate, "lost");
  const Outcome outcome = Halfstep(here.path(), {"certify", "run"});
  ASSERT_EQ(outcome.status, kSuccess) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("dichotomy/published: certified, "));
  EXPECT_TRUE(ReadText(here / certificate) == before);
  CheckRunIsWhole(here / "run", {"dichotomy", "dichotomy_published"});
  // With more demanded than the walk was smoothed for, it fails and says at what.
  const Outcome more =
      Halfstep(here.path(), {"certify", "run", "--set", "smoothing.margins.clearance_m=0.05"});
  EXPECT_EQ(more.status, kFailed);
  EXPECT_THAT(more.out, HasSubstr("dichotomy: violated: clearance of "));
  EXPECT_EQ(nlohmann::json::parse(ReadText(here / "run/dichotomy/certificate.json"))["verdict"],
            "violated");
}

TEST_F(CompareCommandTest, CertifyRefusesOverlapsThatDoNotFit) {
  const TemporaryFolder here;
  const std::string run = Damaged(here, "dichotomy/overlaps.csv", "up_down,", "up_down,9");
  const Outcome outcome = Halfstep(here.path(), {"certify", run});
  EXPECT_EQ(outcome.status, kBadInput);
  EXPECT_THAT(outcome.err, HasSubstr("overlaps.csv: certify: is not as the run wrote it"));
  EXPECT_EQ(Halfstep(here.path(), {"certify", "nowhere"}).status, kBadInput);
}

}  // namespace
}  // namespace halfstep
