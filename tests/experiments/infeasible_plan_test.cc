// What `run` says of a plan that is not feasible.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "experiments/commands/commands.h"
#include "experiments/run/missed_demands_text.h"
#include "smoothing/proof/missed_demands.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/run_check.h"
#include "tests/patterns.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"
#include "tests/wpg/one_step.h"

namespace halfstep {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

TEST(RunCommand, InfeasiblePlanIsWrittenAndFails) {
  const TemporaryFolder place;
  const Outcome outcome = Halfstep(place.path(), {"run", ShippedConfig("bar_8cm"), "--quiet",
                                                  "--set", "half_step.via_height_m=0.05"});
  EXPECT_EQ(outcome.status, kFailed);
  // A leg that does not reach for a moment is the gravest, in the list as in the table.
  const std::string heading = "halfstep: the plan is not feasible; worst first:\n";
  ASSERT_THAT(outcome.err, testing::StartsWith(heading + "  footstep "));
  EXPECT_THAT(outcome.err.substr(0, outcome.err.find('\n', heading.size())),
              HasSubstr(" leg is 0.8 mm too short (at "));
  EXPECT_THAT(outcome.err, HasSubstr("  footstep 1 (right), half-step down, at 2.37 s: RLEG_LINK5 "
                                     "is 45.1 mm inside bar; 5.0 mm demanded (at "));
  EXPECT_THAT(outcome.err, HasSubstr("\n  what may help with clearance: a higher "
                                     "`half_step.via_height_m`, other footsteps"));
  const fs::path run = place / "runs/bar_8cm";
  CheckRunIsWhole(run, {"dichotomy", "dichotomy_published"});
  const ParsedCsv summary(ReadText(run / "summary.csv"));
  for (size_t i = 0; i < 3; ++i)
    EXPECT_EQ(summary.Text(i, "status"), i == 0 ? "failed" : "not_run");
  EXPECT_LT(summary.Number(0, "worst_margin"), 0.0);
  EXPECT_EQ(summary.Text(0, "worst_margin_name"), "reach");
  EXPECT_EQ(ReadText(run / "raw/trajectory.csv"), ReadText(run / "dichotomy/trajectory.csv"));
  const std::string certificate = ReadText(run / "raw/certificate.json");
  EXPECT_THAT(certificate, HasSubstr("\"verdict\": \"violated\""));
  EXPECT_THAT(certificate, HasSubstr("\"message\": \"clearance of "));
}

// Each remedy that is told is tried again, as a user would.
TEST(RunCommand, AnInfeasiblePlanTellsWhatHelps) {
  const TemporaryFolder place;
  const std::vector<std::string> run = {
      "run",   ShippedConfig("bar_8cm"),        "--set",      "half_step.via_height_m=0.15",
      "--set", "smoothing.methods=[dichotomy]", "--overwrite"};
  const Outcome outcome = Halfstep(place.path(), run);
  EXPECT_EQ(outcome.status, kFailed);
  EXPECT_THAT(outcome.out, Not(HasSubstr("not feasible"))) << "told once";
  int for_all = 0, for_one = 0;
  std::vector<std::string> with_each = run;
  for (const auto& told :
       AllMatches(outcome.err,
                  "tried, and feasible: (every footstep|footstep \\d): .*\\(`(\\S+): (\\S+)`\\)")) {
    const std::string set = told[2] + "=" + told[3];
    if (told[1] == "every footstep") {
      ++for_all;
      std::vector<std::string> with = run;
      with.insert(with.end(), {"--set", set});
      EXPECT_EQ(Halfstep(place.path(), with).status, kSuccess) << set;
    } else {
      ++for_one;
      with_each.insert(with_each.end(), {"--set", set});
    }
  }
  EXPECT_GE(for_all, 1) << outcome.err;
  EXPECT_GE(for_one, 2) << outcome.err;
  EXPECT_EQ(Halfstep(place.path(), with_each).status, kSuccess);
}

// Three stairs with the feet as far apart as on the floor: a leg is too short, and less so for a
// robot that crouches.
TEST(RunCommand, AnInfeasiblePlanTellsHowMuchToCrouch) {
  const TemporaryFolder place;
  std::vector<std::string> run = {
      "run",   ShippedConfig("stairs_10cm"), "--overwrite", "--set", "start.left.y_m=0.105",
      "--set", "start.right.y_m=-0.105"};
  for (int i = 0; i < 4; ++i) {
    const std::string y = i % 2 == 0 ? "-0.105" : "0.105";
    run.insert(run.end(), {"--set", "footsteps." + std::to_string(i) + ".y_m=" + y});
  }
  const Outcome outcome = Halfstep(place.path(), run);
  EXPECT_EQ(outcome.status, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr(" leg is 2."));
  EXPECT_THAT(outcome.err, HasSubstr("tried, and feasible: every footstep: 0.5 cm of crouch "
                                     "(`half_step.crouch_m: 0.005`)"));
  run.insert(run.end(), {"--set", "half_step.crouch_m=0.005"});
  EXPECT_EQ(Halfstep(place.path(), run).status, kSuccess);
}

// A plan misses a demand between the instants that are looked at, where the proof found it.
TEST(RunCommand, AnInfeasiblePlanTellsWhatItMissesForAMoment) {
  const RobotModel robot = LoadRobot(InSources("wpg/robots/hrp2.yaml"));
  const HalfStepSequence sequence = OneStep(robot);
  const SuperposedWalk walk(sequence, PlannedMotion(sequence));
  const MarginEvaluator evaluator(robot, Scene{}, MarginLimits{});
  const Margin witness{
      .family = MarginFamily::kFloor, .value = 0.004, .at = {1, 1.9}, .t = 3.9, .subject = 0};
  const MissedDemands missed = FindMissedDemands(evaluator, walk, witness);
  const std::vector<std::string> lines = MissedDemandsText(evaluator, sequence, missed);
  EXPECT_THAT(lines, testing::Contains(testing::AllOf(
                         testing::StartsWith("footstep 1 (left), half-step down, at 3.90 s: "),
                         HasSubstr(" (only between the 201 sampled instants)"))));
}

// Of many pairs of bodies that are too near each other, the nearest at its nearest comes first.
TEST(RunCommand, AnInfeasiblePlanTellsEveryDemandTheWorstFirst) {
  const TemporaryFolder place;
  const Outcome outcome =
      Halfstep(place.path(), {"run", ShippedConfig("fig3_two_half_steps"), "--quiet", "--set",
                              "smoothing.margins.self_clearance_m=0.1"});
  EXPECT_EQ(outcome.status, kFailed);
  std::istringstream lines(outcome.err);
  std::vector<double> margins;
  bool helps = false;
  for (std::string line; std::getline(lines, line);) {
    helps = helps || line.find("or less demanded (`smoothing.margins.self_clearance_m` below ") !=
                         std::string::npos;
    const PatternMatch found =
        FirstMatch(line,
                   "^  (?:at the start|footstep \\d .* s): \\S+ is (\\S+) mm from "
                   "\\S+; 0.1 m demanded \\(at \\d+ of \\d+ instants\\)");
    if (!found) continue;
    margins.push_back(std::stod(found[1]));
  }
  EXPECT_TRUE(helps) << outcome.err;
  EXPECT_EQ(margins.size(), 10u);
  EXPECT_TRUE(std::is_sorted(margins.begin(), margins.end()));
  EXPECT_THAT(outcome.err, testing::ContainsRegex("\n  and [0-9]+ more\n"));
  const ParsedCsv summary(ReadText(place / "runs/fig3_two_half_steps/summary.csv"));
  EXPECT_NEAR(summary.Number(0, "worst_margin"), 1e-3 * margins.front(), 2e-4)
      << "the least along the whole walk";
}

}  // namespace
}  // namespace halfstep
