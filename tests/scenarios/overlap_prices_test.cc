// What a junction's overlap costs, against bisecting it anew with less demanded.

#include "smoothing/methods/overlap_prices.h"

#include <gtest/gtest.h>

#include "smoothing/methods/dichotomy.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/scenarios/load_experiment.h"
#include "tests/smoothing/smoothed.h"
#include "tests/smoothing/test_walks.h"

namespace halfstep {
namespace {

// The largest certified overlap of junction j between its own and 0.1 s more, the rest as it is
// [s].
double LargestOverlap(const Experiment& e, const MarginEvaluator& evaluator, HomotopyParameters at,
                      size_t j) {
  const CertifiedFeasibility test(evaluator, {});
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  const int junction = static_cast<int>(j);
  double feasible = at.overlaps[j];
  double infeasible = std::min(feasible + 0.1, NaturalOverlapBound(at, junction));
  while (infeasible - feasible > 1e-5) {
    at.overlaps[j] = 0.5 * (feasible + infeasible);
    const SuperposedWalk walk(e.sequence, at);
    const TimeSpan span{walk.start_of(junction), walk.end_of(junction + 1)};
    const bool holds = test.Check(walk, span, &scratch).verdict == Verdict::kFeasible;
    (holds ? feasible : infeasible) = at.overlaps[j];
  }
  return feasible;
}

TEST(Explain, ThePriceIsWhatTheOverlapGainsWhenLessIsDemanded) {
  const Experiment e = LoadExperiment("bar_8cm");
  const MarginEvaluator evaluator(e.robot, e.scene, e.config.smoothing.limits);
  SmoothingResult result = Smoothed(
      Dichotomy, ProblemOf(e.sequence, CertifiedFeasibility(evaluator, {})), {.tolerance = 1e-4});
  AddPrices(SuperposedWalk(e.sequence, result.parameters), evaluator, &result.junctions);
  constexpr double kLess = 0.01;  // of the family's scale
  int priced = 0;
  for (size_t j = 0; j < result.junctions.size() && priced < 3; ++j) {
    const JunctionResult& junction = result.junctions[j];
    if (!junction.price) continue;
    ++priced;
    ASSERT_TRUE(junction.limited_by);
    MarginLimits relaxed = evaluator.limits();
    const MarginFamily family = junction.limited_by->family;
    relaxed.demanded_of(family) -= kLess * Scale(family);
    const double gained = LargestOverlap(e, evaluator.WithLimits(relaxed), result.parameters, j) -
                          LargestOverlap(e, evaluator, result.parameters, j);
    EXPECT_NEAR(gained / kLess, *junction.price, 0.2 * *junction.price + 1e-3)
        << "junction " << j + 1 << ", " << Name(family);
  }
  EXPECT_EQ(priced, 3);
}

TEST(Explain, WhatNothingLimitsHasNoPrice) {
  const Experiment e = LoadExperiment("fig3_two_half_steps");
  const MarginEvaluator evaluator(e.robot, e.scene, e.config.smoothing.limits);
  std::vector<JunctionResult> junctions(1);
  junctions[0].price = 1.0;
  AddPrices(SuperposedWalk(e.sequence, PlannedMotion(e.sequence)), evaluator, &junctions);
  EXPECT_FALSE(junctions[0].price);
}

}  // namespace
}  // namespace halfstep
