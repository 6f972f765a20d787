#include "smoothing/methods/improve_ahead.h"

#include <gtest/gtest.h>

#include <memory>

#include "smoothing/methods/dichotomy.h"
#include "smoothing/proof/certified_feasibility.h"
#include "smoothing/proof/stoppable_feasibility.h"
#include "tests/scenarios/load_experiment.h"
#include "tests/smoothing/smoothed.h"

namespace halfstep {
namespace {

std::shared_ptr<const FeasibilityTest> Stoppable(const Experiment& e, const Scene& scene) {
  return std::make_shared<StoppableFeasibility>(
      std::make_shared<CertifiedFeasibility>(
          MarginEvaluator(e.robot, scene, e.config.smoothing.limits), CertificationOptions{}),
      StopBranches::kAll);
}

class ImproveAheadTest : public testing::Test {
 protected:
  // A walk with overlaps, proved by `test`.
  WalkPlan Overlapped(const std::shared_ptr<const FeasibilityTest>& test) const {
    const SmoothingResult found =
        Smoothed(Dichotomy, WalkProblem(e_.sequence, test), {.tolerance = 0.3});
    EXPECT_TRUE(found.feasible) << found.message;
    return {e_.sequence, found.parameters};
  }
  const Experiment e_ = LoadExperiment("bar_8cm");
};

TEST_F(ImproveAheadTest, KeepsWhatHasBegunAndIsProvedWithStopBranches) {
  // Obstacles at rest, and those that may go anywhere at 0.01 mm/s.
  Scene uncertain = e_.scene;
  for (Obstacle& obstacle : uncertain.obstacles) {
    obstacle.motion.error = 2e-4;
    obstacle.motion.speed = 1e-5;
  }
  ASSERT_FALSE(uncertain.rests());
  for (const Scene& scene : {e_.scene, uncertain}) {
    const auto test = Stoppable(e_, scene);
    const WalkPlan walk = Overlapped(test);
    for (const int first : {0, 1, 2}) {
      SmoothingMonitor monitor;
      const auto found =
          ImproveAhead(walk, test, first,
                       {.window = 4, .choice = {.heights = true, .durations = true}}, monitor);
      ASSERT_TRUE(found) << first;
      const SuperposedWalk before = walk.Walk(), after(e_.sequence, *found);
      EXPECT_LT(after.duration(), before.duration() - 0.3);
      const int begin = (first + 1) / 2 * 2;
      EXPECT_EQ(CommonHalfSteps(before, after), begin);
      EXPECT_EQ(AgreeUntil(before, after), before.start_of(begin));
      MarginEvaluator::Scratch scratch = test->evaluator().MakeScratch();
      EXPECT_EQ(test->Check(after, {0.0, after.duration()}, &scratch).verdict, Verdict::kFeasible);
    }
  }
}

TEST_F(ImproveAheadTest, ReturnsNothingWithoutTimeOrHalfSteps) {
  const auto test = Stoppable(e_, e_.scene);
  const WalkPlan walk = Overlapped(test);
  SmoothingMonitor late({.deadline = 0.0}), monitor;
  EXPECT_FALSE(ImproveAhead(walk, test, 2, {}, late));
  EXPECT_FALSE(ImproveAhead(walk, test, walk.sequence.size() - 1, {}, monitor));
  EXPECT_THROW((void)ImproveAhead(walk, test, walk.sequence.size(), {}, monitor), std::logic_error);
  EXPECT_THROW((void)ImproveAhead(walk, test, 0, {.window = 3}, monitor), std::logic_error);
}

}  // namespace
}  // namespace halfstep
