// Windows of a walk, and the method that goes along a walk by them.

#include "smoothing/methods/horizon.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include "smoothing/methods/dichotomy.h"
#include "smoothing/methods/methods.h"
#include "smoothing/methods/solver_method_options.h"
#include "smoothing/methods/walk_window.h"
#include "smoothing/proof/certified_feasibility.h"
#include "smoothing/proof/stoppable_feasibility.h"
#include "tests/scenarios/load_experiment.h"
#include "tests/scenarios/straight_walk.h"
#include "tests/scenarios/stubborn.h"
#include "tests/smoothing/smoothed.h"
#include "tests/smoothing/test_walks.h"

namespace halfstep {
namespace {

// How much the walk and the part differ where half-step k of the part begins, and in the middle and
// at the end of its stretch: the largest difference of a value or rate.
double DifferenceOnStretch(const SuperposedWalk& walk, const SuperposedWalk& part, int begin,
                           int k) {
  const auto end = [](const SuperposedWalk& w, int i) {
    return (i + 1 == w.num_half_steps() ? w.duration() : w.start_of(i + 1)) - w.start_of(i);
  };
  double largest = std::abs(end(walk, begin + k) - end(part, k));
  for (const double fraction : {0.0, 0.5, 1.0}) {
    const double tau = fraction * end(part, k);
    largest = std::max(
        largest,
        (Stacked(walk.At({begin + k, tau})) - Stacked(part.At({k, tau}))).cwiseAbs().maxCoeff());
  }
  return largest;
}

class WindowTest : public testing::Test {
 protected:
  const Experiment e_ = LoadExperiment("fig3_two_half_steps");
  const CertifiedFeasibility test_{{e_.robot, e_.scene, e_.config.smoothing.limits}, {}};
};

TEST_F(WindowTest, ThePartDoesWhatTheWalkDoesOnWhatIsProvedAndNothingElseChanges) {
  WalkDraw draw(1701);
  int compared = 0, needed = 0;
  for (int i = 0; i < 40; ++i) {
    const HalfStepSequence sequence = draw.Sequence(8);
    const WalkProblem problem = ProblemOf(sequence, test_);
    HomotopyParameters at = draw.ExtremeParameters(sequence);
    const int first = 2 * static_cast<int>(draw.Uniform(0, 6));
    const int last = first + 1 + 2 * static_cast<int>(draw.Uniform(0, 8 - first / 2));
    if (draw.Uniform(0, 1) < 0.5 && last + 1 < sequence.size()) {
      at.overlaps[static_cast<size_t>(last)] = 0.0;  // ends at rest
    }
    const SuperposedWalk before(sequence, at);
    const WalkWindow window = WindowOf(problem, at, first, last);
    // Everything that the window may change.
    HomotopyParameters moved = window.parameters;
    const ParameterTable table =
        window.problem.Parameters({.heights = true, .durations = true, .support_points = true});
    for (const ParameterRow& row : table.rows()) {
      if (row.fixed || draw.Uniform(0, 1) < 0.3) continue;
      double& value = row.parameter.in(moved);
      value = row.parameter.family == ParameterFamily::kOverlap
                  ? value * draw.Uniform(0.5, 1.0)
                  : std::clamp(value * draw.Uniform(0.9, 1.2), row.lower, row.upper);
    }
    for (int j = 0; j < window.problem.sequence().num_junctions(); ++j) {
      const size_t at_j = static_cast<size_t>(j);
      if (!table.free({ParameterFamily::kOverlap, j})) continue;
      moved.overlaps[at_j] = std::min(moved.overlaps[at_j], NaturalOverlapBound(moved, j));
    }
    HomotopyParameters whole = at;
    window.Paste(moved, &whole);
    EXPECT_EQ(window.Cut(whole), moved);
    const SuperposedWalk after(sequence, whole), part(window.problem.sequence(), moved);
    for (int k = 0; k < sequence.size(); ++k) {
      const int in_part = k - window.begin;
      if (in_part >= window.proved_first && in_part <= window.proved_last) {
        EXPECT_LT(DifferenceOnStretch(after, part, window.begin, in_part), 1e-6) << k;
        ++compared;
      } else {
        EXPECT_LT(DifferenceOnStretch(after, before, 0, k), 1e-6) << k;
        const bool there = in_part >= 0 && in_part < part.num_half_steps();
        if (there && DifferenceOnStretch(after, part, window.begin, in_part) > 1e-3) ++needed;
      }
    }
  }
  EXPECT_GT(compared, 40 * 3);
  // Neighbours are cut off themselves, so what they do in the part is not what they do in the walk.
  EXPECT_GT(needed, 0);
}

TEST_F(WindowTest, WhatTheProblemFixesStaysFixed) {
  WalkDraw draw(1702);
  const HalfStepSequence sequence = draw.Sequence(6);
  const HomotopyParameter T{ParameterFamily::kDuration, 5}, overlap{ParameterFamily::kOverlap, 6};
  const WalkProblem problem = ProblemOf(sequence, test_, {{T, {}}, {overlap, -0.1}});
  const WalkWindow window = WindowOf(problem, problem.Start(), 4, 9);
  const ParameterTable table = window.problem.Parameters({.durations = true});
  const int begin = window.begin;
  EXPECT_FALSE(table.free({ParameterFamily::kDuration, 5 - begin}));
  EXPECT_FALSE(table.free({ParameterFamily::kOverlap, 6 - begin}));
  EXPECT_EQ(table.row({ParameterFamily::kOverlap, 6 - begin}).start, -0.1);
  for (const int i : {4, 6, 7, 8, 9}) {
    EXPECT_TRUE(table.free({ParameterFamily::kDuration, i - begin})) << i;
  }
  for (const int i : {3, 4, 5, 7, 8}) {
    EXPECT_TRUE(table.free({ParameterFamily::kOverlap, i - begin})) << i;
  }
}

MethodOptions Along(bool durations, int passes = 2) {
  MethodOptions options;
  options.Edit(HorizonGroup()) = {.window = 4, .step = 2, .passes = passes};
  OptimizerOptions& optimizer = options.Edit(OptimizerGroup()).options;
  optimizer.program.parameters = {.heights = durations, .durations = durations};
  optimizer.tolerance = 0.01;
  optimizer.effort = 15.0;
  return options;
}

SmoothingResult Horizon(const WalkProblem& problem, const MethodOptions& options,
                        SmoothingMonitor& monitor) {
  return Methods::Standard().Find("halfstep/horizon").Smooth(problem, options, monitor);
}

TEST(Horizon, EveryIncumbentIsCertifiedAndTheWalkIsShorterThanTheDichotomys) {
  const Experiment e = LoadExperiment("bar_8cm");
  const CertifiedFeasibility test({e.robot, e.scene, e.config.smoothing.limits}, {});
  const SmoothingResult dichotomy =
      Smoothed(Dichotomy, ProblemOf(e.sequence, test), {.tolerance = 0.01});
  std::vector<HomotopyParameters> accepted;
  const SmoothingResult result =
      Smoothed(Horizon, ProblemOf(e.sequence, test), Along(true),
               {.on_incumbent = [&](const HomotopyParameters& p) { accepted.push_back(p); }});
  EXPECT_TRUE(opt::HasOwnResult(result.ending)) << result.message;
  EXPECT_EQ(result.evidence, Evidence::kCertified);
  EXPECT_LT(DurationOf(result.parameters), 0.8 * DurationOf(dichotomy.parameters));
  MarginEvaluator::Scratch scratch = test.evaluator().MakeScratch();
  double shortest = DurationOf(PlannedMotion(e.sequence));
  EXPECT_GT(accepted.size(), 5u);
  accepted.push_back(result.parameters);
  for (const HomotopyParameters& parameters : accepted) {
    const SuperposedWalk walk(e.sequence, parameters);
    EXPECT_EQ(test.Check(walk, {0.0, walk.duration()}, &scratch).verdict, Verdict::kFeasible);
    EXPECT_LE(walk.duration(), shortest + 1e-9);
    shortest = walk.duration();
  }
  EXPECT_NEAR(result.cost, shortest, 1e-9);
}

TEST(Horizon, OneBadHalfStepCostsItsWindowOnly) {
  const Experiment e = LoadExperiment("bar_8cm");
  const CertifiedFeasibility test({e.robot, e.scene, e.config.smoothing.limits}, {});
  const Stubborn stubborn(test, e.sequence.half_steps[7]);
  const SmoothingResult result = Smoothed(Horizon, ProblemOf(e.sequence, stubborn), Along(true, 3));
  const std::vector<double>& T = result.parameters.durations;
  const std::vector<double> planned = PlannedMotion(e.sequence).durations;
  EXPECT_EQ(T[7], planned[7]);
  // T_1 alone says little: where Δ_1 is as long as half-step 2 allows, both may grow for nothing.
  for (const size_t k : {0u, 2u}) EXPECT_LT(T[k], 0.95 * planned[k]) << k;
  for (const size_t k : {0u, 1u, 2u}) {
    EXPECT_LT(T[k] - result.parameters.overlaps[k], 0.75 * planned[k]) << k;
  }
}

// Regression: what a window gained is refused in the whole walk, and the gain of all was lost.
TEST(Horizon, WhatIsRefusedInTheWholeCostsNothingElsewhere) {
  const Experiment e = LoadExperiment("fig3_two_half_steps");
  const CertifiedFeasibility test({e.robot, Scene{}, e.config.smoothing.limits}, {});
  const HalfStepSequence sequence = StraightWalk(e, 8);
  const Stubborn stubborn(test, sequence.half_steps[3], sequence.size());
  MethodOptions options = Along(true);
  options.Edit(HorizonGroup()).passes = 1;
  const SmoothingResult result = Smoothed(Horizon, ProblemOf(sequence, stubborn), options);
  const std::vector<double>& T = result.parameters.durations;
  const std::vector<double> planned = PlannedMotion(sequence).durations;
  EXPECT_EQ(T[3], planned[3]);
  for (const size_t k : {0u, 8u, 10u, 12u, 15u}) EXPECT_LT(T[k], 0.95 * planned[k]) << k;
}

TEST(Horizon, ProvesStopBranchesWhereTheyAreDemanded) {
  const Experiment e = LoadExperiment("bar_8cm");
  const auto inner = std::make_shared<CertifiedFeasibility>(
      MarginEvaluator(e.robot, e.scene, e.config.smoothing.limits), CertificationOptions{});
  const StoppableFeasibility test(inner, StopBranches::kAll);
  const WalkProblem problem = ProblemOf(e.sequence, test);
  const SmoothingResult result = Smoothed(Horizon, problem, Along(true));
  const SmoothingResult dichotomy = Smoothed(Dichotomy, problem, {.tolerance = 0.01});
  EXPECT_LT(DurationOf(result.parameters), 0.95 * DurationOf(dichotomy.parameters));
  const SuperposedWalk walk(e.sequence, result.parameters);
  MarginEvaluator::Scratch scratch = test.evaluator().MakeScratch();
  EXPECT_EQ(test.Check(walk, {0.0, walk.duration()}, &scratch).verdict, Verdict::kFeasible);
}

TEST(Horizon, ItsCostIsLinearInTheWalk) {
  const Experiment e = LoadExperiment("bar_8cm");
  const CertifiedFeasibility test({e.robot, Scene{}, e.config.smoothing.limits}, {});
  std::vector<double> efforts;
  for (const int steps : {8, 16}) {
    const HalfStepSequence sequence = StraightWalk(e, steps);
    MethodOptions options = Along(false);
    options.Edit(HorizonGroup()).passes = 1;
    const SmoothingResult result = Smoothed(Horizon, ProblemOf(sequence, test), options);
    EXPECT_TRUE(result.feasible) << result.message;
    efforts.push_back(result.work.effort());
  }
  EXPECT_GT(efforts[1], 1.6 * efforts[0]);
  EXPECT_LT(efforts[1], 2.4 * efforts[0]);
}

TEST(Horizon, RefusesAProgramThatBelongsToTheWholeWalk) {
  const Experiment e = LoadExperiment("fig3_two_half_steps");
  const CertifiedFeasibility test({e.robot, e.scene, e.config.smoothing.limits}, {});
  for (const bool curve : {false, true}) {
    MethodOptions options;
    if (curve) {
      options.Edit(OptimizerGroup()).program = "pareto";
    } else {
      options.Edit(OptimizerGroup()).options.program.kind = ProgramKind::kSafest;
    }
    const Methods methods = Methods::Standard();
    SmoothingMonitor monitor;
    const SmoothingResult result =
        methods.Find("halfstep/horizon").Smooth(ProblemOf(e.sequence, test), options, monitor);
    EXPECT_EQ(result.ending, opt::Ending::kInvalidInput);
    EXPECT_THAT(result.message, testing::HasSubstr("(valid: fastest, smooth)"));
    EXPECT_TRUE(result.feasible);
    EXPECT_EQ(result.parameters, PlannedMotion(e.sequence));
  }
}

TEST(Horizon, LowersTheRoughnessToo) {
  const Experiment e = LoadExperiment("fig3_two_half_steps");
  const CertifiedFeasibility test({e.robot, e.scene, e.config.smoothing.limits}, {});
  MethodOptions options = Along(true);
  ProgramOptions& smooth = options.Edit(OptimizerGroup()).options.program;
  smooth.kind = ProgramKind::kSmooth;
  const SmoothingResult result = Smoothed(Horizon, ProblemOf(e.sequence, test), options);
  EXPECT_TRUE(opt::HasOwnResult(result.ending)) << result.message;
  const OverlapProgram program(e.sequence, test.evaluator(), smooth, 0.0);
  EXPECT_NEAR(result.cost, program.Cost(result.parameters), 1e-9);
  EXPECT_LT(result.cost, 0.8 * program.Cost(PlannedMotion(e.sequence)));
}

}  // namespace
}  // namespace halfstep
