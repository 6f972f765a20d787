#include "smoothing/proof/sampled_feasibility.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/scenarios/load_experiment.h"
#include "tests/smoothing/test_walks.h"

namespace halfstep {
namespace {

class SampledFeasibilityTest : public testing::Test {
 protected:
  // Check over the whole walk with `demanded` of one family and nothing of the others.
  Feasibility CheckFamily(MarginFamily family, double demanded, double period, const TimeSpan& span,
                          long* instants) const {
    MarginLimits limits = experiment_.config.smoothing.limits;
    limits.demanded.fill(-100.0);
    // It is −∞ where the ZMP is outside the support polygon.
    limits.demanded_of(MarginFamily::kFriction) = kNotDemanded;
    limits.demanded_of(family) = demanded;
    const MarginEvaluator evaluator(experiment_.robot, experiment_.scene, limits);
    MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
    const auto answer = SampledFeasibility(evaluator, period).Check(walk_, span, &scratch);
    *instants = scratch.work.evaluated();
    return answer;
  }

  const Experiment experiment_ = LoadExperiment("bar_8cm");
  const SuperposedWalk walk_{experiment_.sequence, Overlapped(experiment_.sequence, 0.5)};
  const MarginEvaluator evaluator_{experiment_.robot, experiment_.scene,
                                   experiment_.config.smoothing.limits};
};

TEST_F(SampledFeasibilityTest, FeasibleLooksAtEveryInstantOfTheGridOnceAndNoMore) {
  // 0.1 s by 7 ms: 15 pieces, 16 instants; a whole number of periods is not rounded up.
  for (const auto& [span, period, count] : {std::tuple{TimeSpan{1.0, 1.1}, 0.007, 16},
                                            {TimeSpan{1.0, 1.1}, 0.005, 21},
                                            {TimeSpan{1.0, 1.1}, 1.0, 2},
                                            {TimeSpan{0.0, 1.0}, 0.005, 201},
                                            {TimeSpan{0.7, 0.7}, 0.005, 2}}) {
    long instants = 0;
    const auto answer = CheckFamily(MarginFamily::kZmp, -10, period, span, &instants);
    EXPECT_EQ(answer.verdict, Verdict::kFeasible);
    EXPECT_EQ(answer.evidence, Evidence::kSampled);
    EXPECT_EQ(instants, count) << period;
  }
}

// Demands a hair more than the least sample: only an instant that is looked at can tell.
TEST_F(SampledFeasibilityTest, NoInstantOfTheGridIsLeftOut) {
  WalkDraw draw(70);
  for (int i = 0; i < Draws(40); ++i) {
    const double period = 0.005;
    const double begin = draw.Uniform(0, walk_.duration() - 0.5);
    const TimeSpan span{begin, begin + period * std::floor(draw.Uniform(1, 100))};
    const long n = std::lround((span.end - span.begin) / period);
    MarginEvaluator::Scratch scratch = evaluator_.MakeScratch();
    Margin least{.family = MarginFamily::kZmp};
    for (long k = 0; k <= n; ++k) {
      const double t =
          span.begin + (span.end - span.begin) / static_cast<double>(n) * static_cast<double>(k);
      const Margin here =
          evaluator_.At(walk_, walk_.Locate(t), &scratch)[static_cast<size_t>(MarginFamily::kZmp)];
      if (here.value < least.value) least = here;
    }
    long instants = 0;
    const auto above =
        CheckFamily(MarginFamily::kZmp, least.value + 1e-12, period, span, &instants);
    ASSERT_EQ(above.verdict, Verdict::kViolated);
    EXPECT_NEAR(above.witness.value, least.value, 1e-12);
    EXPECT_LE(instants, n + 1);
    const auto below =
        CheckFamily(MarginFamily::kZmp, least.value - 1e-12, period, span, &instants);
    EXPECT_EQ(below.verdict, Verdict::kFeasible);
    EXPECT_EQ(instants, n + 1);
  }
}

TEST_F(SampledFeasibilityTest, AViolationOutsideTheWindowDoesNotCount) {
  MarginEvaluator::Scratch scratch = evaluator_.MakeScratch();
  const Margin least =
      SampleMargins(evaluator_, walk_, 0.005, &scratch)[static_cast<size_t>(MarginFamily::kZmp)];
  long instants = 0;
  const double demanded = least.value + 1e-4;
  const TimeSpan at{least.t - 0.01, least.t + 0.01}, before{0.0, 0.3};
  EXPECT_EQ(CheckFamily(MarginFamily::kZmp, demanded, 0.001, at, &instants).verdict,
            Verdict::kViolated);
  EXPECT_EQ(CheckFamily(MarginFamily::kZmp, demanded, 0.001, before, &instants).verdict,
            Verdict::kFeasible);
}

TEST_F(SampledFeasibilityTest, SampleMarginsAreTheLeastOverTheGridWithTheirPlaces) {
  MarginEvaluator::Scratch scratch = evaluator_.MakeScratch();
  const MarginSet coarse = SampleMargins(evaluator_, walk_, 0.02, &scratch);
  EXPECT_EQ(scratch.work.instants, std::lround(std::ceil(walk_.duration() / 0.02)) + 1);
  const MarginSet fine = SampleMargins(evaluator_, walk_, 0.01, &scratch);
  for (size_t f = 0; f < coarse.size(); ++f) {
    EXPECT_EQ(coarse[f].family, MarginFamily{static_cast<int>(f)});
    const MarginSet there = evaluator_.At(walk_, coarse[f].at, &scratch);
    EXPECT_EQ(there[f].value, coarse[f].value);
    EXPECT_NEAR(walk_.Absolute(coarse[f].at), coarse[f].t, 1e-13);
    EXPECT_LE(fine[f].value, coarse[f].value + 1e-3);
  }
  // Relative to demand and scale, not the smallest number.
  const MarginLimits& limits = evaluator_.limits();
  const Margin& worst = WorstOf(coarse, limits);
  for (const Margin& margin : coarse) EXPECT_GE(limits.Slack(margin), limits.Slack(worst));
}

TEST_F(SampledFeasibilityTest, SaysWhatItIsAndRefusesAPeriodOfZero) {
  const SampledFeasibility test(evaluator_, 0.005);
  EXPECT_EQ(test.Description(), "sampled every 5 ms");
  EXPECT_EQ(test.evidence(), Evidence::kSampled);
  EXPECT_EQ(Name(test.evidence()), "sampled");
  EXPECT_THROW(SampledFeasibility(evaluator_, 0.0), std::logic_error);
}

}  // namespace
}  // namespace halfstep
