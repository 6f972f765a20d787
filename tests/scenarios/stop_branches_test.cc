// Stop branches of smoothed walks: smoothing/README.md, "Stop branches".

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "smoothing/methods/dichotomy.h"
#include "smoothing/methods/overlap_optimizer.h"
#include "smoothing/proof/certified_feasibility.h"
#include "smoothing/proof/stoppable_feasibility.h"
#include "tests/scenarios/load_experiment.h"
#include "tests/smoothing/smoothed.h"

namespace halfstep {
namespace {

class StoppedScene : public testing::TestWithParam<const char*> {
 protected:
  // The half-steps after which the walk cannot be stopped, each branch proved whole by itself.
  std::vector<int> Refused(const HomotopyParameters& parameters) const {
    std::vector<int> refused;
    const SuperposedWalk walk(scene_.sequence, parameters);
    MarginEvaluator::Scratch scratch = test_->evaluator().MakeScratch();
    for (int k = 0; k < walk.num_half_steps(); ++k) {
      const SuperposedWalk branch = walk.StopBranch(k);
      const Feasibility answer = test_->Check(branch, {0.0, branch.duration()}, &scratch);
      if (answer.verdict != Verdict::kFeasible) refused.push_back(k);
    }
    return refused;
  }
  SmoothingResult Optimized(StopBranches branches) const {
    OptimizerOptions options;
    options.program.parameters = {.heights = true, .durations = true};
    options.rounds = 1;
    options.effort = 1.0;
    const StoppableFeasibility stoppable(test_, branches);
    return Smoothed(OptimizeOverlaps, ProblemOf(scene_.sequence, stoppable), options);
  }

  const Experiment scene_ = LoadExperiment(GetParam());
  const std::shared_ptr<const CertifiedFeasibility> test_ = std::make_shared<CertifiedFeasibility>(
      MarginEvaluator(scene_.robot, scene_.scene, scene_.config.smoothing.limits),
      CertificationOptions{});
};

TEST_P(StoppedScene, TheDichotomyFromLeftToRightProvesEveryBranchWithoutAsking) {
  const SmoothingResult result = Smoothed(Dichotomy, ProblemOf(scene_.sequence, *test_), {});
  ASSERT_TRUE(result.feasible);
  EXPECT_EQ(Refused(result.parameters), std::vector<int>{});
}

TEST_P(StoppedScene, EveryMethodKeepsTheBranchesThatAreDemanded) {
  const StoppableFeasibility stoppable(test_, StopBranches::kAll);
  for (const auto order :
       {DichotomyOptions::Order::kLeftToRight, DichotomyOptions::Order::kRightToLeft}) {
    DichotomyOptions options;
    options.order = order;
    const SmoothingResult result =
        Smoothed(Dichotomy, ProblemOf(scene_.sequence, stoppable), options);
    EXPECT_EQ(Refused(result.parameters), std::vector<int>{});
  }
  EXPECT_EQ(Refused(Optimized(StopBranches::kAll).parameters), std::vector<int>{});
  for (const int k : Refused(Optimized(StopBranches::kDown).parameters)) {
    EXPECT_EQ(scene_.sequence.half_steps[static_cast<size_t>(k)].half_step.kind, HalfStepKind::kUp);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, StoppedScene, testing::Values("fig5_box", "bar_8cm"));

// The control: what nobody demands of a joint program it does not keep.
class StoppedBar : public StoppedScene {};

TEST_P(StoppedBar, AJointProgramDoesNotKeepWhatIsNotDemanded) {
  EXPECT_NE(Refused(Optimized(StopBranches::kNone).parameters), std::vector<int>{});
}

INSTANTIATE_TEST_SUITE_P(Bar, StoppedBar, testing::Values("bar_8cm"));

}  // namespace
}  // namespace halfstep
