#include <gtest/gtest.h>

#include <string>

#include "smoothing/methods/dichotomy.h"
#include "smoothing/proof/certified_feasibility.h"
#include "smoothing/proof/sampled_feasibility.h"
#include "tests/scenarios/load_experiment.h"
#include "tests/smoothing/smoothed.h"
#include "tests/wpg/shipped_robots.h"

namespace halfstep {
namespace {

SmoothingResult SmoothedBy(const Experiment& e, const HalfStepSequence& sequence) {
  const MarginEvaluator evaluator(e.robot, e.scene, e.config.smoothing.limits);
  const CertifiedFeasibility test(evaluator, e.config.smoothing.certification);
  return Smoothed(Dichotomy, ProblemOf(sequence, test),
                  e.config.smoothing.options.Get(DichotomyGroup()));
}

class OtherShippedRobot : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Robots, OtherShippedRobot, testing::Values("wren", "bison"),
                         [](const auto& info) { return info.param; });

TEST_P(OtherShippedRobot, WalksSixStepsCertified) {
  const Experiment e = LoadExperiment(GetParam() + "_six_steps");
  ASSERT_EQ(e.sequence.size(), 12);
  const SmoothingResult result = SmoothedBy(e, e.sequence);
  const SuperposedWalk planned(e.sequence, PlannedMotion(e.sequence));
  const SuperposedWalk walk(e.sequence, result.parameters);
  EXPECT_LT(walk.duration(), 0.45 * planned.duration());

  const MarginEvaluator evaluator(e.robot, e.scene, e.config.smoothing.limits);
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  Certificate certificate;
  const CertifiedFeasibility test(evaluator, e.config.smoothing.certification);
  EXPECT_EQ(test.Certify(walk, &scratch, &certificate).verdict, Verdict::kFeasible);
  EXPECT_GT(certificate.size(), 100u);
  const SampledFeasibility dense(evaluator, 2e-4);
  EXPECT_EQ(dense.Check(walk, {0.0, walk.duration()}, &scratch).verdict, Verdict::kFeasible);
}

TEST_P(OtherShippedRobot, WalksTheMirroredStepsAlike) {
  const Experiment e = LoadExperiment(GetParam() + "_six_steps");
  const HomotopyParameters here = SmoothedBy(e, e.sequence).parameters;
  const HomotopyParameters there = SmoothedBy(e, Mirrored(e.sequence)).parameters;
  ASSERT_EQ(here.overlaps.size(), there.overlaps.size());
  for (size_t i = 0; i < here.overlaps.size(); ++i) {
    EXPECT_NEAR(here.overlaps[i], there.overlaps[i], 1e-6) << i;
  }
}

}  // namespace
}  // namespace halfstep
