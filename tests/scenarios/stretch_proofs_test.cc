#include "smoothing/proof/stretch_proofs.h"

#include <gtest/gtest.h>

#include "smoothing/methods/dichotomy.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/scenarios/load_experiment.h"
#include "tests/smoothing/fake_feasibility.h"
#include "tests/smoothing/smoothed.h"
#include "tests/smoothing/test_walks.h"

namespace halfstep {
namespace {

// Some parameters changed, the rest as they were; overlaps stay in their bounds.
HomotopyParameters Changed(const HalfStepSequence& sequence, HomotopyParameters parameters,
                           WalkDraw* draw) {
  for (const HomotopyParameter& p : AllParameters(sequence)) {
    if (draw->Uniform(0, 1) > 0.12) continue;
    p.in(parameters) *= draw->Uniform(0.8, 1.2);
    const ParameterFamilyTraits& traits = Traits(p.family);
    if (traits.of_form) p.in(parameters) = std::clamp(p.in(parameters), traits.least, traits.most);
  }
  for (int i = 0; i < sequence.num_junctions(); ++i) {
    double& overlap = parameters.overlaps[static_cast<size_t>(i)];
    overlap = std::min(overlap, NaturalOverlapBound(parameters, i));
  }
  return parameters;
}

double EndOfStretch(const SuperposedWalk& walk, int k) {
  return k + 1 == walk.num_half_steps() ? walk.duration() : walk.start_of(k + 1);
}

TEST(StretchProofs, StretchesWithTheSameParametersAreTheSameMotion) {
  constexpr int kDraws = 60;  // with fewer, as with sanitizers, there may be no stretch that stays
  WalkDraw draw(320);
  int same = 0, different = 0;
  for (int i = 0; i < kDraws; ++i) {
    const HalfStepSequence sequence = draw.Sequence(6);
    const HomotopyParameters from = draw.Parameters(sequence, 0.0, 1.0);
    const SuperposedWalk before(sequence, from);
    const SuperposedWalk after(sequence, Changed(sequence, from, &draw));
    for (int k = 0; k < sequence.size(); ++k) {
      if (StretchParameters(before, k) != StretchParameters(after, k)) {
        ++different;
        continue;
      }
      ++same;
      const double length = EndOfStretch(after, k) - after.start_of(k);
      EXPECT_NEAR(length, EndOfStretch(before, k) - before.start_of(k), 1e-12);
      for (int s = 0; s < 10; ++s) {
        const LocalTime at{k, draw.Uniform(0, length)};
        EXPECT_LT((Stacked(after.At(at)) - Stacked(before.At(at))).cwiseAbs().maxCoeff(), 1e-8);
        EXPECT_EQ(after.StepInAir(at), before.StepInAir(at));
      }
    }
  }
  EXPECT_GT(same, kDraws / 3);
  EXPECT_GT(different, kDraws);
}

TEST(StretchProofs, OnlyWhatChangedIsProvedAgain) {
  const MarginEvaluator evaluator(Hrp2(), {}, {});
  const FakeFeasibility test(evaluator,
                             [](const HomotopyParameters&) { return Verdict::kFeasible; });
  const HalfStepSequence sequence = WalkDraw(80).Sequence(3);
  HomotopyParameters parameters = PlannedMotion(sequence);
  StretchProofs proofs(test, sequence.size());
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  EXPECT_TRUE(proofs.Refusals(SuperposedWalk(sequence, parameters), &scratch).empty());
  EXPECT_EQ(test.questions.size(), 6u);
  EXPECT_TRUE(proofs.Refusals(SuperposedWalk(sequence, parameters), &scratch).empty());
  EXPECT_EQ(test.questions.size(), 6u);
  parameters.overlaps[2] = 0.1;  // between half-steps 2 and 3
  EXPECT_TRUE(proofs.Refusals(SuperposedWalk(sequence, parameters), &scratch).empty());
  EXPECT_EQ(test.questions.size(), 8u);
  parameters.overlaps[2] = 0.0;  // and back: nothing is new
  EXPECT_TRUE(proofs.Refusals(SuperposedWalk(sequence, parameters), &scratch).empty());
  EXPECT_EQ(test.questions.size(), 8u);
}

// A walk that overlaps too much in two places is refused there and nowhere else, and the answer
// agrees with the test of the whole walk.
TEST(StretchProofs, RefusesWhereTheWalkIsRefused) {
  const Experiment e = LoadExperiment("bar_8cm");
  const MarginEvaluator evaluator(e.robot, e.scene, e.config.smoothing.limits);
  const CertifiedFeasibility test(evaluator, {});
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  const HomotopyParameters good =
      Smoothed(Dichotomy, ProblemOf(e.sequence, test), {.tolerance = 0.01}).parameters;
  StretchProofs proofs(test, e.sequence.size());
  EXPECT_TRUE(proofs.Refusals(SuperposedWalk(e.sequence, good), &scratch).empty());
  HomotopyParameters shorter = good;
  for (double& overlap : shorter.overlaps) overlap *= 0.5;
  std::vector<HomotopyParameters> candidates = {good, shorter, Overlapped(e.sequence, 0.99)};
  WalkDraw draw(7);
  for (int i = 0; i < Draws(10); ++i) candidates.push_back(Changed(e.sequence, good, &draw));
  int refused = 0, proved = 0;
  for (const HomotopyParameters& candidate : candidates) {
    const SuperposedWalk walk(e.sequence, candidate);
    const std::vector<Margin> refusals = proofs.Refusals(walk, &scratch);
    const Verdict whole = test.Check(walk, {0.0, walk.duration()}, &scratch).verdict;
    EXPECT_EQ(refusals.empty(), whole == Verdict::kFeasible);
    (refusals.empty() ? proved : refused) += 1;
    double last = -1.0;
    for (const Margin& refusal : refusals) {
      EXPECT_GE(refusal.t, last);
      last = refusal.t;
    }
  }
  EXPECT_GT(refused, 0);
  EXPECT_GT(proved, 0);
}

TEST(StretchProofs, AsksAboutWholeStretchesAndUndecidedIsNoProof) {
  const MarginEvaluator evaluator(Hrp2(), {}, {});
  const HalfStepSequence sequence = WalkDraw(81).Sequence(3);
  const SuperposedWalk walk(sequence, Overlapped(sequence, 0.3));
  for (const Verdict verdict : {Verdict::kFeasible, Verdict::kUndecided, Verdict::kViolated}) {
    const FakeFeasibility test(evaluator, [&](const HomotopyParameters&) { return verdict; });
    StretchProofs proofs(test, sequence.size());
    MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
    const size_t refused = proofs.Refusals(walk, &scratch).size();
    EXPECT_EQ(refused, verdict == Verdict::kFeasible ? 0u : static_cast<size_t>(sequence.size()));
    double covered = 0.0;
    for (const FakeFeasibility::Question& question : test.questions) {
      EXPECT_EQ(question.span.begin, covered);
      covered = question.span.end;
    }
    EXPECT_EQ(covered, walk.duration());
  }
}

}  // namespace
}  // namespace halfstep
