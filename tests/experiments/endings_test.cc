// How methods ended, in everything that the command writes and prints.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stop_token>

#include "experiments/commands/commands.h"
#include "experiments/tables/ending_words.h"
#include "opt/solvers/ending.h"
#include "smoothing/methods/methods.h"
#include "smoothing/methods/smoothing_monitor.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/run_check.h"
#include "tests/temporary_folder.h"

namespace halfstep {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr char kRefuses[] = "nlopt/bobyqa";  // knows no constraints

bool IsThere(const std::string& method) {
  const std::vector<std::string> names = Methods::Standard().Names();
  return std::find(names.begin(), names.end(), method) != names.end();
}

// A run of fig3 with the methods, over overlaps, heights and durations.
Outcome RunOf(const TemporaryFolder& place, const std::string& methods, const std::string& out) {
  return Halfstep(place.path(), {"run", ShippedConfig("fig3_two_half_steps"), "--out", out, "--set",
                                 "smoothing.methods=[" + methods + "]", "--set",
                                 "smoothing.optimizer.heights=true", "--set",
                                 "smoothing.optimizer.durations=true"});
}

class Endings : public testing::Test {
 protected:
  void SetUp() override {
    if (!IsThere(kRefuses)) GTEST_SKIP() << "no " << kRefuses << " in this build";
  }
  TemporaryFolder place_;
};

TEST_F(Endings, ASolverThatRefusedReadsInvalidInputEverywhere) {
  const Outcome run = RunOf(place_, "dichotomy, nlopt/bobyqa, halfstep/sqp", "run");
  EXPECT_EQ(run.status, kFailed);
  EXPECT_THAT(run.err, testing::StartsWith("halfstep: nlopt/bobyqa: invalid_input: nlopt/bobyqa "
                                           "refused the program; "));
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_THAT(run.out, HasSubstr("\nnlopt/bobyqa           invalid_input    certified "));
  EXPECT_THAT(run.out, Not(HasSubstr("nlopt/bobyqa (")));  // nothing is told of its walk

  const ParsedCsv summary(ReadText(place_ / "run/summary.csv"));
  EXPECT_EQ(summary.Text(0, "status"), "converged");
  EXPECT_EQ(summary.Text(1, "status"), "converged");
  EXPECT_EQ(summary.Text(2, "status"), "invalid_input");
  EXPECT_TRUE(HasOwnResult(*opt::EndingOf(summary.Text(3, "status"))));
  EXPECT_EQ(summary.Text(2, "certified"), "true");
  EXPECT_NEAR(summary.Number(2, "duration_s"), summary.Number(1, "duration_s"), 0.002);
  const std::string schema = ReadText(place_ / "run/summary.schema.json");
  EXPECT_THAT(schema, HasSubstr(opt::EndingNames()));
  const auto manifest = nlohmann::json::parse(ReadText(place_ / "run/manifest.json"));
  EXPECT_EQ(manifest["methods"][2]["status"], "invalid_input");
  EXPECT_THAT(manifest["methods"][2]["message"].get<std::string>(), HasSubstr("constraints"));

  const Outcome compared = Halfstep(place_.path(), {"compare", "run", "--out", "comparison"});
  ASSERT_EQ(compared.status, kSuccess) << compared.err;
  EXPECT_THAT(compared.out, testing::MatchesRegex("[^\n]*best certified: cost [0-9.]* by "
                                                  "halfstep/sqp\n(.|\n)*"));
  const ParsedCsv comparison(ReadText(place_ / "comparison/comparison.csv"));
  EXPECT_EQ(comparison.Text(2, "status"), "invalid_input");
  EXPECT_EQ(comparison.Text(2, "gap_to_best"), "inf");
  EXPECT_EQ(comparison.Text(2, "time_to_5pct_s"), "");
  const ParsedCsv means(ReadText(place_ / "comparison/means.csv"));
  EXPECT_EQ(means.Text(1, "method"), kRefuses);
  EXPECT_EQ(means.Number(1, "failed"), 1);
  EXPECT_EQ(means.Number(1, "ended"), 0);
  EXPECT_EQ(means.Number(1, "speedup_mean"), 1);

  ASSERT_EQ(Halfstep(place_.path(), {"export", "run", "--format", "ompl", "--out", "logs"}).status,
            kSuccess);
  const std::string log = ReadText(place_ / "logs/fig3_two_half_steps.log");
  EXPECT_THAT(log, HasSubstr("\nstatus|converged|limit|deadline|interrupted|no_improvement|not_run|"
                             "invalid_input|failed|"));
  const size_t at = log.find("\n1 runs\n", log.find("\nnlopt/bobyqa\n")) + 8;
  EXPECT_EQ(log.substr(at, 6), "6; 0; ") << "the seventh, not solved";

  if (!HasReport()) return;
  for (const std::string page : {"run/report.html", "comparison/report.html"}) {
    const std::string text = ReadText(place_ / page);
    EXPECT_THAT(text, HasSubstr("\"status\":\"invalid_input\"")) << page;
    EXPECT_THAT(text, HasSubstr("\"own\":false")) << page;
    EXPECT_THAT(text, HasSubstr(std::string(Meaning(opt::Ending::kInvalidInput)))) << page;
  }
}

TEST_F(Endings, ALoneSolverThatRefusedIsNotBest) {
  EXPECT_EQ(RunOf(place_, kRefuses, "run").status, kFailed);
  const Outcome compared = Halfstep(place_.path(), {"compare", "run"});
  ASSERT_EQ(compared.status, kSuccess) << compared.err;
  EXPECT_THAT(compared.out, HasSubstr("best certified: cost 4.0000 by raw\n"));
}

TEST_F(Endings, OfASweepAreThoseOfItsRuns) {
  WriteText(place_ / "base.yaml",
            "{robot: hrp2, scene: none, footsteps: [{foot: right, x_m: 0.2, y_m: -0.105}],\n"
            " smoothing: {methods: [dichotomy, nlopt/bobyqa], dichotomy: {tolerance_s: 0.1}}}\n");
  WriteText(place_ / "sweep.yaml",
            "config: base.yaml\nvary:\n  - {key: half_step.via_height_m, values: [0.25]}\n");
  const Outcome sweep =
      Halfstep(place_.path(), {"sweep", "sweep.yaml", "--jobs", "1", "--out", "out"});
  ASSERT_EQ(sweep.status, kSuccess) << sweep.err;
  EXPECT_THAT(sweep.out, HasSubstr("1 cases, 3 rows: 2 converged, 1 invalid_input; 3 certified"));
  const ParsedCsv runs(ReadText(place_ / "out/runs.csv"));
  EXPECT_EQ(runs.Text(2, "status"), "invalid_input");
  EXPECT_THAT(runs.Text(2, "message"), HasSubstr("refused the program"));
}

TEST_F(Endings, AnOldWordIsRefusedWithTheValidOnes) {
  (void)RunOf(place_, "dichotomy", "run");
  std::string text = ReadText(place_ / "run/summary.csv");
  text.replace(text.find("\ndichotomy,converged,") + 11, 9, "finished");
  WriteText(place_ / "run/summary.csv", text);
  const std::string said = "status: 'finished' (valid: " + opt::EndingNames() + ")";
  std::vector<std::vector<std::string>> commands = {
      {"compare", "run"}, {"export", "run", "--format", "ompl", "--out", "logs"}};
  if (HasReport()) commands.push_back({"report", "run", "--out", "page.html"});
  for (const std::vector<std::string>& command : commands) {
    const Outcome outcome = Halfstep(place_.path(), command);
    EXPECT_EQ(outcome.status, kBadInput) << command.front();
    EXPECT_THAT(outcome.err, HasSubstr("run/summary.csv")) << command.front();
    EXPECT_THAT(outcome.err, HasSubstr(said)) << command.front();
  }
}

// What a method says of its ending is told by the words of the monitor, whatever its status.
TEST(EndingsByTheClock, AreToldByEndingOrMessage) {
  const SmoothingMonitor late({.deadline = 0.0});
  std::stop_source source;
  const SmoothingMonitor stopped({.stop = source.get_token()});
  source.request_stop();
  const SmoothingMonitor used({.effort = 0.0});
  for (const opt::Ending ending : opt::kEndings) {
    const bool by_clock = ending == opt::Ending::kDeadline;
    const bool from_outside = ending == opt::Ending::kInterrupted;
    EXPECT_EQ(NotRepeatable(ending, "").empty(), !by_clock && !from_outside) << Name(ending);
    if (by_clock || from_outside) continue;
    EXPECT_EQ(NotRepeatable(ending, late.StopReason()), "ended by the clock, not repeatable");
    EXPECT_EQ(NotRepeatable(ending, stopped.StopReason()), "stopped from outside, not repeatable");
    EXPECT_EQ(NotRepeatable(ending, used.StopReason()), "");
  }
}

TEST(EndingsByTheClock, AreMarkedWhereverARowIsShown) {
  constexpr char kMark[] = "ended by the clock, not repeatable";
  const TemporaryFolder place;
  const std::vector<std::string> arguments = {
      "run",   ShippedConfig("fig3_two_half_steps"),
      "--set", "smoothing.methods=[dichotomy, halfstep/sqp]",
      "--set", "smoothing.optimizer.deadline_s=1e-9"};  // over before the first solve
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), arguments.begin(), arguments.end());
    return Halfstep(place.path(), more);
  };
  const Outcome run = with({"--out", "run"});
  EXPECT_THAT(run.out, testing::ContainsRegex(std::string("\nhalfstep/sqp [^\n]*\\(") + kMark));
  EXPECT_THAT(run.out, Not(testing::ContainsRegex(std::string("\ndichotomy [^\n]*\\(") + kMark)));
  const auto json = nlohmann::json::parse(with({"--out", "again", "--json"}).out);
  EXPECT_EQ(json["methods"][1]["repeatable"], true);
  EXPECT_EQ(json["methods"][2]["repeatable"], false);
  const Outcome compared = Halfstep(place.path(), {"compare", "run"});
  EXPECT_THAT(compared.out,
              testing::ContainsRegex(std::string("\nhalfstep/sqp [^\n]*\\(") + kMark));
  if (!HasReport()) return;
  EXPECT_THAT(ReadText(place / "run/report.html"),
              HasSubstr(std::string("\"not_repeatable\":\"") + kMark));
}

TEST(EndingsAmongObstaclesThatMove, AMethodThatCannotRunSaysSo) {
  const TemporaryFolder place;
  const Outcome run =
      Halfstep(place.path(), {"run", ShippedConfig("crossing"), "--out", "run", "--set",
                              "smoothing.methods=[dichotomy, halfstep/horizon]", "--set",
                              "smoothing.optimizer.program=safest"});
  EXPECT_EQ(run.status, kFailed);
  EXPECT_THAT(run.err, HasSubstr("halfstep: halfstep/horizon: invalid_input: "));
  EXPECT_THAT(run.err, HasSubstr("no program `safest`"));
  const ParsedCsv summary(ReadText(place / "run/summary.csv"));
  EXPECT_EQ(summary.Text(1, "status"), "converged");
  EXPECT_EQ(summary.Text(2, "status"), "invalid_input");
  for (const char* format : {"csv", "hrpsys"}) {
    const Outcome exported = Halfstep(place.path(), {"export", "run", "--format", format, "--out",
                                                     format, "--method", "dichotomy"});
    EXPECT_EQ(exported.status, kSuccess) << exported.err;
  }
}

}  // namespace
}  // namespace halfstep
