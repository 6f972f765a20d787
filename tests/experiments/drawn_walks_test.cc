// Walks that are drawn at random, and a sweep over configs.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "experiments/config/experiment.h"
#include "experiments/run/exit_status.h"
#include "experiments/sweep/sweep_config.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/parsed_csv.h"
#include "tests/experiments/run_check.h"
#include "tests/temporary_folder.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

TEST(DrawnWalks, AreFeasibleAsPlannedAndTheSameFromTheSameSeed) {
  const TemporaryFolder place;
  const auto draw = [&](const std::string& out, const std::string& seed) {
    return Halfstep(place.path(), {"draw", "walks", "--count", "3", "--seed", seed, "--out", out});
  };
  ASSERT_EQ(draw("a", "4").status, kSuccess);
  ASSERT_EQ(draw("b", "4").status, kSuccess);
  ASSERT_EQ(draw("c", "5").status, kSuccess);
  for (const std::string name : {"walk_1.yaml", "walk_1_scene.yaml", "walk_3.yaml", "walks.yaml"}) {
    EXPECT_EQ(ReadText(place / ("a/" + name)), ReadText(place / ("b/" + name))) << name;
  }
  EXPECT_NE(ReadText(place / "a/walk_1.yaml"), ReadText(place / "c/walk_1.yaml"));
  for (const std::string name : {"walk_1", "walk_2", "walk_3"}) {
    const Experiment e = Prepare(LoadConfig((place / ("a/" + name + ".yaml")).string(), {}));
    EXPECT_EQ(e.scene.name, name + "_scene");
    EXPECT_GE(e.sequence.num_steps(), 4);
    EXPECT_LE(e.sequence.num_steps(), 40);
    const CertifiedFeasibility test(MarginEvaluator(e.robot, e.scene, e.config.smoothing.limits),
                                    e.config.smoothing.certification);
    const SuperposedWalk walk(e.sequence, PlannedMotion(e.sequence));
    MarginEvaluator::Scratch scratch = test.evaluator().MakeScratch();
    EXPECT_EQ(test.Check(walk, {0.0, walk.duration()}, &scratch).verdict, Verdict::kFeasible);
  }
}

TEST(DrawnWalks, AreSweptOver) {
  const TemporaryFolder place;
  ASSERT_EQ(Halfstep(place.path(), {"draw", "walks", "--count", "2", "--out", "w"}).status,
            kSuccess);
  const Outcome swept = Halfstep(
      place.path(), {"sweep", "w/walks.yaml", "--set",
                     "vary.0.values=[\"[dichotomy, reference/lipm]\"]", "--out", "s", "--quiet"});
  EXPECT_EQ(swept.status, kSuccess) << swept.err;
  const std::string rows = ReadText(place / "s/runs.csv");
  EXPECT_THAT(rows, HasSubstr(",walk_1.yaml,"));
  EXPECT_THAT(rows, HasSubstr(",walk_2.yaml,"));
  // How far above the lower bound, but of the planned motion and the dichotomy's walk alone.
  const ParsedCsv runs(rows);
  for (int row = 0; row < 3; ++row) {
    const bool is_bound = runs.Text(row, "method") == "reference/lipm";
    EXPECT_EQ(runs.Text(row, "gap_lipm").empty(), is_bound);
    if (!is_bound) {
      EXPECT_GT(runs.Number(row, "gap_lipm"), 0.0);
    }
  }
  EXPECT_GT(runs.Number(0, "gap_lipm"), runs.Number(1, "gap_lipm"));
  const std::string config = ReadText(place / "s/cases" /
                                      SweepCases(LoadSweep((place / "s/sweep.yaml").string(), {},
                                                           /*check=*/true))[1]
                                          .id /
                                      "config.yaml");
  EXPECT_THAT(config, HasSubstr("name: walk_2-0002-"));
  // What a case's config is belongs to what the sweep is.
  WriteText(place / "w/walk_2.yaml", ReadText(place / "w/walk_2.yaml") + "seed: 3\n");
  const Outcome other =
      Halfstep(place.path(), {"sweep", "w/walks.yaml", "--set", "vary.0.values=[\"[dichotomy]\"]",
                              "--out", "s", "--quiet"});
  EXPECT_EQ(other.status, kBadInput);
  EXPECT_THAT(other.err, HasSubstr("holds a sweep of"));
}

TEST(DrawnWalks, MistakesAreTold) {
  const TemporaryFolder place;
  const auto told = [&](const std::vector<std::string>& arguments) {
    const Outcome outcome = Halfstep(place.path(), arguments);
    EXPECT_EQ(outcome.status, kBadInput);
    return outcome.err;
  };
  EXPECT_THAT(told({"draw", "walks"}), HasSubstr("draw: walks: --out is missing"));
  EXPECT_THAT(told({"draw", "cylinders", "--out", "x"}), HasSubstr("--out is for walks"));
  EXPECT_THAT(told({"draw", "walks", "--count", "1001", "--out", "x"}),
              HasSubstr("--count: 1001 walks (valid: 1 … 1000)"));
  fs::create_directory(place / "there");
  EXPECT_THAT(told({"draw", "walks", "--out", "there"}), HasSubstr("there: is there already"));
  EXPECT_FALSE(fs::exists(place / "x"));
  WriteText(place / "s.yaml", "config: " + ShippedConfig("fig3_two_half_steps") +
                                  "\nvary:\n  - {key: config, values: [no_such.yaml]}\n");
  EXPECT_THAT(told({"sweep", "s.yaml"}), HasSubstr("no_such.yaml"));
}

}  // namespace
}  // namespace halfstep
