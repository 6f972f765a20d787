// Several threads find what one finds: walks, candidates, work and certificates, to the bit.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <tuple>

#include "smoothing/methods/dichotomy.h"
#include "smoothing/methods/horizon.h"
#include "smoothing/methods/methods.h"
#include "smoothing/methods/solver_method_options.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/scenarios/load_experiment.h"
#include "tests/scenarios/same_results.h"
#include "tests/smoothing/smoothed.h"

namespace halfstep {
namespace {

using testing::TestWithParam;

void ExpectSame(const Certificate& a, const Certificate& b) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(std::tuple(a[i].begin, a[i].end, a[i].family, a[i].count, a[i].bound),
              std::tuple(b[i].begin, b[i].end, b[i].family, b[i].count, b[i].bound));
    EXPECT_EQ(Content(a[i].margin), Content(b[i].margin));
  }
}

MethodOptions Few() {
  MethodOptions options;
  OptimizerOptions& optimizer = options.Edit(OptimizerGroup()).options;
  options.Edit(DichotomyGroup()).tolerance = optimizer.tolerance = 0.01;
  optimizer.program.parameters = {.heights = true, .durations = true};
  optimizer.rounds = 2;
  optimizer.instants = 12;
  optimizer.effort = 1.5;  // ends some of them in the middle of a round
  options.Edit(HorizonGroup()).passes = 1;
  return options;
}

class ThreadsTest : public TestWithParam<const char*> {
 protected:
  // Two steps over a bar.
  static Experiment Load() {
    Experiment e = LoadExperiment("bar_8cm");
    e.config.footsteps.resize(2);
    return Prepare(e.config);
  }
};

TEST_P(ThreadsTest, FindWhatOneFinds) {
  const Experiment e = Load();
  const CertifiedFeasibility test({e.robot, e.scene, e.config.smoothing.limits}, {});
  SmoothingResult alone;
  Certificate alone_rows;
  for (const int threads : {0, 1, 2, 3}) {
    SCOPED_TRACE(threads);
    const auto workers = threads > 0 ? std::make_shared<Workers>(threads) : nullptr;
    SmoothingMonitor monitor({.workers = workers});
    SmoothingResult result =
        Methods::Standard().Find(GetParam()).Smooth(ProblemOf(e.sequence, test), Few(), monitor);
    const SuperposedWalk walk(e.sequence, result.parameters);
    MarginEvaluator::Scratch scratch = test.evaluator().MakeScratch();
    scratch.workers = workers.get();
    Certificate rows;
    EXPECT_EQ(test.Certify(walk, &scratch, &rows).verdict, Verdict::kFeasible);
    if (threads == 0) {
      EXPECT_LT(result.cost, 0.8 * DurationOf(PlannedMotion(e.sequence)));
      EXPECT_GT(result.work.effort(), 0.0);
      alone = std::move(result);
      alone_rows = std::move(rows);
      continue;
    }
    ExpectSame(alone, result);
    ExpectSame(alone_rows, rows);
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, ThreadsTest,
                         testing::Values("dichotomy", "dichotomy/uniform", "halfstep/sqp",
                                         "halfstep/horizon", "halfstep/barrier"),
                         [](const auto& info) {
                           const std::string name = info.param;
                           return name.substr(name.find('/') + 1);
                         });

// Where a walk is refused the same interval refuses it, and no work beyond it is counted.
TEST(Threads, RefuseWhatOneRefuses) {
  const Experiment e = LoadExperiment("bar_8cm");
  const CertifiedFeasibility test({e.robot, e.scene, e.config.smoothing.limits}, {});
  Workers workers(3);
  int refused = 0;
  for (int junction = 0; junction < e.sequence.num_junctions(); ++junction) {
    HomotopyParameters parameters = PlannedMotion(e.sequence);
    parameters.overlaps[static_cast<size_t>(junction)] = NaturalOverlapBound(parameters, junction);
    const SuperposedWalk walk(e.sequence, parameters);
    MarginEvaluator::Scratch alone = test.evaluator().MakeScratch();
    MarginEvaluator::Scratch shared = test.evaluator().MakeScratch();
    shared.workers = &workers;
    for (int repeat = 0; repeat < 3; ++repeat) {
      const TimeSpan all{0.0, walk.duration()};
      const Feasibility a = test.Check(walk, all, &alone), b = test.Check(walk, all, &shared);
      ASSERT_EQ(a.verdict, b.verdict);
      EXPECT_EQ(Content(a.witness), Content(b.witness));
      EXPECT_EQ(alone.work, shared.work);
      EXPECT_EQ(alone.bodies.queries, shared.bodies.queries);
      refused += a.verdict == Verdict::kViolated;
    }
  }
  EXPECT_GE(refused, 9);
}

}  // namespace
}  // namespace halfstep
