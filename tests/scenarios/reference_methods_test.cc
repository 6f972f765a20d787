// What other methods are compared with: uniform scan and coordinate ascent, with feasibility given
// by a rule on the parameters, and the grid's dynamic programming against trying everything.

#include <gtest/gtest.h>

#include <cmath>
#include <stop_token>

#include "smoothing/methods/dichotomy.h"
#include "smoothing/methods/methods.h"
#include "smoothing/methods/solver_method_options.h"
#include "smoothing/methods/uniform_scan.h"
#include "smoothing/program/overlap_program.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/benchmarks/coordinate_ascent.h"
#include "tests/benchmarks/dynamic_program.h"
#include "tests/benchmarks/reference_search.h"
#include "tests/benchmarks/reference_smoothers.h"
#include "tests/scenarios/load_experiment.h"
#include "tests/smoothing/fake_feasibility.h"
#include "tests/smoothing/smoothed.h"
#include "tests/smoothing/test_walks.h"

namespace halfstep {
namespace {

class ReferenceMethods : public testing::Test {
 protected:
  // Feasible while T ≥ `shortest` times (0.5 + η/2) of the planned one and Δ ≤ 0.2 s.
  FakeFeasibility LowFeetMayHurry(double shortest) const {
    const HomotopyParameters planned = PlannedMotion(sequence_);
    return {evaluator_, [planned, shortest](const HomotopyParameters& p) {
              for (size_t k = 0; k < p.durations.size(); ++k) {
                const double factor = shortest * (0.5 + 0.5 * p.height_scales[k / 2]);
                if (p.durations[k] < factor * planned.durations[k]) return Verdict::kViolated;
              }
              for (double overlap : p.overlaps) {
                if (overlap > 0.2) return Verdict::kUndecided;
              }
              return Verdict::kFeasible;
            }};
  }

  const MarginEvaluator evaluator_{Hrp2(), {}, {}};
  const HalfStepSequence sequence_ = WalkDraw(80).Sequence(2);  // 3 junctions
};

TEST_F(ReferenceMethods, TheScanFindsTheBestUniformFactors) {
  const FakeFeasibility test = LowFeetMayHurry(1.0);
  // Heights down to 0.4, so durations down to 0.7: both are grid points.
  const UniformScanOptions options{
      .least_height = 0.4, .height_step = 0.2, .duration_step = 0.15, .coarse = 0.1, .fine = 0.01};
  const SmoothingResult result = Smoothed(UniformScan, ProblemOf(sequence_, test), options);
  EXPECT_EQ(result.ending, opt::Ending::kConverged);
  const HomotopyParameters planned = PlannedMotion(sequence_);
  for (size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(result.parameters.durations[k], 0.7 * planned.durations[k], 1e-9);
    EXPECT_NEAR(result.parameters.height_scales[k / 2], 0.4, 1e-9);
  }
  for (double overlap : result.parameters.overlaps) EXPECT_GT(overlap, 0.19);
  EXPECT_EQ(result.cost, DurationOf(result.parameters));
  double incumbent = DurationOf(planned);
  for (const SmoothingIterate& iterate : result.iterates) {
    EXPECT_LE(iterate.incumbent_duration, incumbent + 1e-12);
    incumbent = iterate.incumbent_duration;
  }
  EXPECT_EQ(incumbent, result.cost);
}

TEST_F(ReferenceMethods, WithoutFamiliesTheScanIsTheDichotomy) {
  const FakeFeasibility test = LowFeetMayHurry(1.0);
  const SmoothingResult scan = Smoothed(UniformScan, ProblemOf(sequence_, test),
                                        {.heights = false, .durations = false, .coarse = 1e-3});
  EXPECT_LE(scan.cost, DurationOf(Smoothed(Dichotomy, ProblemOf(sequence_, test), {}).parameters));
  EXPECT_EQ(scan.parameters.durations, PlannedMotion(sequence_).durations);
}

TEST_F(ReferenceMethods, AnInfeasiblePlannedMotionIsOnlyOneGridPoint) {
  // All must be 5 % slower than planned.
  const SmoothingResult result =
      Smoothed(UniformScan, ProblemOf(sequence_, LowFeetMayHurry(1.05)), {.heights = false});
  EXPECT_EQ(result.ending, opt::Ending::kConverged);
  EXPECT_NEAR(result.parameters.durations[0] / PlannedMotion(sequence_).durations[0], 1.05, 1e-9);
  const SmoothingResult none =
      Smoothed(UniformScan, ProblemOf(sequence_, LowFeetMayHurry(3.0)), {});
  EXPECT_EQ(none.ending, opt::Ending::kNotRun);
  EXPECT_FALSE(none.feasible);
  EXPECT_EQ(none.parameters, PlannedMotion(sequence_));
  EXPECT_FALSE(none.message.empty());
}

TEST_F(ReferenceMethods, CoordinateAscentLowersTheFeetToHurry) {
  const FakeFeasibility test = LowFeetMayHurry(1.0);
  const SmoothingResult result = Smoothed(CoordinateAscent, ProblemOf(sequence_, test),
                                          {.parameters = {.heights = true, .durations = true}});
  EXPECT_EQ(result.ending, opt::Ending::kConverged);
  const HomotopyParameters planned = PlannedMotion(sequence_);
  for (size_t k = 0; k < 4; ++k) {  // η = 0.1
    EXPECT_NEAR(result.parameters.durations[k], 0.55 * planned.durations[k], 0.002);
    EXPECT_EQ(result.parameters.height_scales[k / 2], 0.1);
  }
  for (double overlap : result.parameters.overlaps) EXPECT_NEAR(overlap, 0.2, 0.001);
  EXPECT_NO_THROW(CheckParameters(sequence_, result.parameters));
}

TEST_F(ReferenceMethods, CoordinateAscentChangesOnlyTheFamiliesAskedFor) {
  const FakeFeasibility test = LowFeetMayHurry(0.8);
  const HomotopyParameters planned = PlannedMotion(sequence_);
  const SmoothingResult overlaps = Smoothed(CoordinateAscent, ProblemOf(sequence_, test), {});
  EXPECT_EQ(overlaps.parameters.durations, planned.durations);
  EXPECT_EQ(overlaps.parameters.height_scales, planned.height_scales);
  const SmoothingResult hurried =
      Smoothed(CoordinateAscent, ProblemOf(sequence_, test), {.parameters = {.durations = true}});
  EXPECT_EQ(hurried.parameters.height_scales, planned.height_scales);
  EXPECT_LT(hurried.cost, overlaps.cost - 0.5);
}

TEST_F(ReferenceMethods, StoppedTheyKeepWhatWasFeasible) {
  const FakeFeasibility test = LowFeetMayHurry(0.8);
  std::stop_source source;
  const auto stop = [&](double) { source.request_stop(); };
  const SmoothingResult result = Smoothed(CoordinateAscent, ProblemOf(sequence_, test),
                                          {.parameters = {.heights = true, .durations = true}},
                                          {.progress = stop, .stop = source.get_token()});
  EXPECT_EQ(result.ending, opt::Ending::kInterrupted);
  MarginEvaluator::Scratch scratch = evaluator_.MakeScratch();
  const SuperposedWalk walk(sequence_, result.parameters);
  EXPECT_EQ(test.Check(walk, {}, &scratch).verdict, Verdict::kFeasible);
  EXPECT_LT(result.cost, DurationOf(PlannedMotion(sequence_)));
  const SmoothingResult scan =
      Smoothed(UniformScan, ProblemOf(sequence_, test), {}, {.stop = source.get_token()});
  EXPECT_NE(scan.ending, opt::Ending::kConverged);
  const SmoothingResult grid =
      Smoothed(ReferenceSearch, ProblemOf(sequence_, test), {}, {.stop = source.get_token()});
  EXPECT_EQ(grid.ending, opt::Ending::kNotRun);  // stopped before its first round
  EXPECT_TRUE(grid.feasible);
}

// From the question on at which a stop is asked for, or the effort is used, no method asks
// many more: it finishes what it is at.
TEST_F(ReferenceMethods, StoppedInTheMiddleTheyAskLittleMore) {
  Methods methods = Methods::Standard();
  AddReferenceSmoothers(&methods);
  MethodOptions options;
  options.Edit(OptimizerGroup()).options.program.parameters = {.heights = true, .durations = true};
  options.Edit(OptimizerGroup()).options.effort = 30.0;
  for (const char* name : {"coordinate", "dichotomy/uniform", "reference"}) {
    for (const size_t when : {20u, 100u}) {
      std::stop_source source;
      size_t count = 0;
      const FakeFeasibility rule = LowFeetMayHurry(0.8);
      const FakeFeasibility stops(evaluator_, [&](const HomotopyParameters& p) {
        if (++count == when) source.request_stop();
        MarginEvaluator::Scratch scratch = evaluator_.MakeScratch();
        return rule.Check(SuperposedWalk(sequence_, p), {}, &scratch).verdict;
      });
      SmoothingMonitor monitor({.stop = source.get_token()});
      const SmoothingResult result =
          methods.Find(name).Smooth(ProblemOf(sequence_, stops), options, monitor);
      EXPECT_GE(count, when) << name << ": never stopped";
      EXPECT_LE(count, when + 60) << name;
      EXPECT_NE(result.ending, opt::Ending::kConverged) << name;
      EXPECT_TRUE(result.feasible);
    }
    options.Edit(OptimizerGroup()).options.effort = 1e-6;
    FakeFeasibility spent = LowFeetMayHurry(0.8);
    SmoothingMonitor monitor;
    const SmoothingResult result =
        methods.Find(name).Smooth(ProblemOf(sequence_, spent), options, monitor);
    EXPECT_LE(spent.questions.size(), 60u) << name;
    EXPECT_NE(result.ending, opt::Ending::kConverged) << name << ": " << result.message;
    options.Edit(OptimizerGroup()).options.effort = 30.0;
  }
}

TEST_F(ReferenceMethods, TheyDoNotMoveWhatIsFixed) {
  using Family = HomotopyParameter::Family;
  const FakeFeasibility test = LowFeetMayHurry(0.8);
  const HomotopyParameters planned = PlannedMotion(sequence_);
  const WalkProblem problem = ProblemOf(
      sequence_, test,
      {{{Family::kOverlap, 2}, 0.1}, {{Family::kDuration, 0}}, {{Family::kHeightScale, 1}, 0.5}});
  const ParameterChoice both{.heights = true, .durations = true};
  ReferenceOptions grid{.parameters = both};
  grid.period = 0.1;
  grid.max_rounds = 2;
  for (const SmoothingResult& result : {Smoothed(CoordinateAscent, problem, {.parameters = both}),
                                        Smoothed(ReferenceSearch, problem, grid)}) {
    EXPECT_TRUE(result.feasible) << result.message;
    EXPECT_LT(result.cost, DurationOf(problem.Start()));
    EXPECT_EQ(result.parameters.overlaps[2], 0.1);
    EXPECT_EQ(result.parameters.durations[0], planned.durations[0]);
    EXPECT_EQ(result.parameters.height_scales[1], 0.5);
    EXPECT_TRUE(result.junctions[2].fixed);
    EXPECT_FALSE(result.junctions[1].fixed);
  }
}

// Stretches are looked at apart from each other.
TEST(GridReferenceTest, DoesNotRunAmongObstaclesThatMove) {
  const Experiment e = LoadExperiment("crossing");
  const CertifiedFeasibility test(MarginEvaluator(e.robot, e.scene, e.config.smoothing.limits), {});
  const SmoothingResult result = Smoothed(ReferenceSearch, ProblemOf(e.sequence, test), {});
  EXPECT_EQ(result.ending, opt::Ending::kNotRun);
  EXPECT_NE(result.message.find("obstacles that move"), std::string::npos) << result.message;
}

// Every combination of a few values, each looked at as a whole.
TEST(DynamicProgramTest, FindsWhatTryingEverythingFinds) {
  const Experiment e = LoadExperiment("bar_8cm");
  HalfStepSequence sequence = e.sequence;
  sequence.half_steps.resize(4);
  const MarginEvaluator evaluator(e.robot, e.scene, e.config.smoothing.limits);
  const HomotopyParameters planned = PlannedMotion(sequence);
  for (bool durations : {false, true}) {
    DynamicProgram::Choices choices;
    for (size_t k = 0; k < 4; ++k) {
      choices.push_back({});
      for (double overlap : {0.5, 0.65, 0.8, 0.95}) {
        const double bound = k == 0 ? 0.0 : NaturalOverlapBound(planned, static_cast<int>(k) - 1);
        const bool hurried = durations && choices.back().size() % 2 == 1;
        choices.back().push_back(
            {overlap * bound, planned.durations[k] * (hurried ? 0.9 : 1.0), hurried ? 0.9 : 1.0});
        if (k == 0 && !durations) break;
        if (choices.back().size() == (durations ? 2u : 4u)) break;
      }
    }
    constexpr double kPeriod = 0.02;
    DynamicProgram grid(sequence, evaluator, planned, kPeriod);
    const std::vector<int> found = grid.Solve(choices, 1e9, [] { return false; });
    ASSERT_EQ(found.size(), 4u);
    const double best = DurationOf(grid.ParametersOf(choices, found));

    MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
    const auto feasible = [&](const SuperposedWalk& walk) {
      for (int k = 0; k < 4; ++k) {
        const bool last = k == 3;
        const double stretch = (last ? walk.duration() : walk.start_of(k + 1)) - walk.start_of(k);
        for (double tau = 0; tau < stretch; tau += kPeriod) {
          if (evaluator.FirstViolation(walk, {k, tau}, &scratch)) return false;
        }
      }
      for (double knot : KnotsInside(walk, {0.0, walk.duration()})) {
        if (evaluator.FirstViolation(walk, walk.Locate(knot), &scratch)) return false;
      }
      return true;
    };
    double least = 1e9;
    int tried = 0;
    std::vector<int> indices(4, 0);
    while (true) {
      const HomotopyParameters p = grid.ParametersOf(choices, indices);
      if (DurationOf(p) < least - 1e-9 && feasible(SuperposedWalk(sequence, p))) {
        least = DurationOf(p);
      }
      ++tried;
      size_t k = 0;
      while (k < 4 && ++indices[k] == static_cast<int>(choices[k].size())) indices[k++] = 0;
      if (k == 4) break;
    }
    EXPECT_NEAR(best, least, 1e-9) << tried << " combinations";
    EXPECT_GE(tried, 16);
    // Something is refused, else nothing was shown.
    double shortest = 0.0;
    for (size_t k = 0; k < 4; ++k) {
      double of_k = 1e9;
      for (const StretchChoice& c : choices[k]) of_k = std::min(of_k, c.duration - c.overlap);
      shortest += of_k;
    }
    EXPECT_GT(best, shortest + 1e-6);
    // A bound below what is possible leaves nothing.
    EXPECT_TRUE(grid.Solve(choices, best - 1e-6, [] { return false; }).empty());
    EXPECT_TRUE(grid.Solve(choices, 1e9, [] { return true; }).empty());
  }
}

TEST(GridReferenceTest, IsCertifiedAndNotWorseThanTheDichotomyOrAStart) {
  const Experiment e = LoadExperiment("fig3_two_half_steps");
  const MarginEvaluator evaluator(e.robot, e.scene, e.config.smoothing.limits);
  const CertifiedFeasibility test(evaluator, {});
  const SmoothingResult dichotomy = Smoothed(Dichotomy, ProblemOf(e.sequence, test), {});
  HomotopyParameters infeasible = PlannedMotion(e.sequence);
  infeasible.durations = {0.5, 0.5};
  ReferenceOptions options;
  options.period = options.narrowest = 0.05;
  options.max_rounds = 4;
  options.starts = {infeasible};
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  for (bool durations : {false, true}) {
    options.parameters.heights = options.parameters.durations = durations;
    const SmoothingResult result = Smoothed(ReferenceSearch, ProblemOf(e.sequence, test), options);
    EXPECT_EQ(HasOwnResult(result.ending), result.cost < DurationOf(dichotomy.parameters))
        << result.message;
    EXPECT_NE(result.ending, opt::Ending::kNotRun);
    EXPECT_LE(result.cost, DurationOf(dichotomy.parameters));
    EXPECT_LT(result.cost, DurationOf(dichotomy.parameters) - (durations ? 0.05 : -1e-9));
    const SuperposedWalk walk(e.sequence, result.parameters);
    EXPECT_EQ(test.Check(walk, {0.0, walk.duration()}, &scratch).verdict, Verdict::kFeasible);
    EXPECT_NE(result.message.find("ms"), std::string::npos);
  }
}

}  // namespace
}  // namespace halfstep
