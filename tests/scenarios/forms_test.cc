// Half-steps in forms of their own: what they gain, and that every walk found is certified.

#include <gtest/gtest.h>

#include "smoothing/methods/overlap_optimizer.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/scenarios/load_experiment.h"
#include "tests/smoothing/smoothed.h"

namespace halfstep {
namespace {

// The walk of `halfstep/sqp` over Δ, η, T and what `choice` adds, certified.
HomotopyParameters FastestOf(const Experiment& e, ParameterChoice choice, int rounds = 6,
                             bool windows = false) {
  const MarginEvaluator evaluator(e.robot, e.scene, e.config.smoothing.limits);
  const CertifiedFeasibility test(evaluator, {});
  OptimizerOptions options;
  options.solver = "halfstep/sqp";
  choice.heights = choice.durations = true;
  options.program.parameters = choice;
  options.rounds = rounds;
  if (windows) options.only = SearchStage{.window = 4, .step = 2, .passes = 2, .rounds = rounds};
  options.effort = 2.0;
  options.tolerance = 0.02;
  const WalkProblem problem = ProblemOf(e.sequence, test);
  const SmoothingResult result = Smoothed(OptimizeOverlaps, problem, options);
  const SuperposedWalk walk(e.sequence, result.parameters);
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  EXPECT_EQ(test.Check(walk, {0.0, walk.duration()}, &scratch).verdict, Verdict::kFeasible);
  const ParameterTable table = problem.Parameters(choice);
  for (const ParameterRow& row : table.rows()) {
    if (!Traits(row.parameter.family).of_form) continue;
    EXPECT_GE(row.parameter.in(result.parameters), row.lower - 1e-12);
    EXPECT_LE(row.parameter.in(result.parameters), row.upper + 1e-12);
  }
  return result.parameters;
}

double PlainOverTheBar() {
  static const double shortest = DurationOf(FastestOf(LoadExperiment("bar_8cm"), {}));
  return shortest;
}

TEST(FormsScenario, TogetherTheyShortenAWalkOverABox) {
  const Experiment e = LoadExperiment("fig5_box");
  ParameterChoice forms = EveryFamily();
  forms.footsteps = false;
  const HomotopyParameters plain = FastestOf(e, {}), formed = FastestOf(e, forms);
  EXPECT_LE(DurationOf(formed), 0.85 * DurationOf(plain));
  for (const ParameterFamily family : AllParameterFamilies()) {
    if (!Traits(family).of_form || Traits(family).move != nullptr) continue;
    EXPECT_EQ(plain.of(family), PlannedMotion(e.sequence).of(family)) << Traits(family).name;
    if (Traits(family).of_heights) continue;  // the floor is flat
    EXPECT_NE(formed.of(family), plain.of(family)) << Traits(family).name;
  }
}

// The second footstep comes nearer to the first; where no sole may step it does not.
TEST(FormsScenario, FootstepsThatMoveShortenAWalkOverABar) {
  Experiment e = LoadExperiment("bar_8cm");
  const HomotopyParameters moved = FastestOf(e, {.footsteps = true});
  EXPECT_LT(DurationOf(moved), 0.995 * PlainOverTheBar());
  for (const size_t j : {2, 3}) EXPECT_EQ(moved.footstep_xs[j], 0.0);
  EXPECT_LT(moved.footstep_ys[1], -0.01);
  // Between the soles; FastestOf certifies that none comes there.
  e.scene.no_step.push_back(
      (Eigen::Matrix2Xd(2, 4) << 0.16, 0.38, 0.38, 0.16, -0.012, -0.012, 0.012, 0.012).finished());
  const HomotopyParameters held = FastestOf(e, {.footsteps = true}, 2);
  EXPECT_GT(held.footstep_ys[1], -0.009);
}

// Regression: the program with all families alone found nothing where the one with three did.
TEST(FormsScenario, MoreFamiliesNeverMakeAWalkLonger) {
  for (const char* name : {"fig3_two_half_steps", "bar_5cm"}) {
    const Experiment e = LoadExperiment(name);
    const double plain = DurationOf(FastestOf(e, {}));
    EXPECT_LE(DurationOf(FastestOf(e, EveryFamily())), 1.001 * plain) << name;
  }
}

// By windows, too, all that is found is within its range and certified.
TEST(FormsScenario, WindowsShortenAWalkOverABar) {
  const Experiment e = LoadExperiment("bar_8cm");
  ParameterChoice forms = EveryFamily();
  forms.footsteps = false;
  EXPECT_LE(DurationOf(FastestOf(e, forms, 6, true)), 0.85 * PlainOverTheBar());
}

TEST(FormsScenario, AFormThatIsFixedStays) {
  Experiment e = LoadExperiment("fig3_two_half_steps");
  const MarginEvaluator evaluator(e.robot, e.scene, e.config.smoothing.limits);
  const CertifiedFeasibility test(evaluator, {});
  const std::vector<FixedParameter> fixed = {{{ParameterFamily::kFootDelay, 1}, 0.15},
                                             {{ParameterFamily::kLiftShare, 0}, 0.9}};
  const WalkProblem problem = ProblemOf(e.sequence, test, fixed);
  for (const bool free : {false, true}) {
    OptimizerOptions options;
    options.solver = "halfstep/sqp";
    options.rounds = 2;
    if (free) options.program.parameters = EveryFamily();
    const SmoothingResult result = Smoothed(OptimizeOverlaps, problem, options);
    EXPECT_EQ(result.parameters.of(ParameterFamily::kFootDelay)[1], 0.15);
    EXPECT_EQ(result.parameters.of(ParameterFamily::kLiftShare)[0], 0.9);
    EXPECT_EQ(result.parameters.of(ParameterFamily::kFootDelay)[0] != e.config.half_step.foot_delay,
              free);
  }
  EXPECT_EQ(ComplaintAbout(e.sequence, {{{ParameterFamily::kFootRamp, 1}, 0.6}}),
            "foot_ramp 2: 0.6  is too large (valid: up to 0.5)");
}

}  // namespace
}  // namespace halfstep
