// The programs and the optimizer on shipped experiments.

#include "smoothing/methods/overlap_optimizer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stop_token>
#include <utility>

#include "opt/adapters/solver_registry.h"
#include "smoothing/methods/dichotomy.h"
#include "smoothing/methods/incumbent.h"
#include "smoothing/methods/pareto.h"
#include "smoothing/methods/solver_method_options.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/places.h"
#include "tests/scenarios/load_experiment.h"
#include "tests/smoothing/fake_feasibility.h"
#include "tests/smoothing/smoothed.h"
#include "tests/smoothing/test_walks.h"

namespace halfstep {
namespace {

OptimizerOptions Quick(const std::string& solver) {
  OptimizerOptions options;
  options.solver = solver;
  options.program.parameters.heights = options.program.parameters.durations = true;
  options.program.watch.instants = 8;
  options.rounds = 2;
  options.max_iterations = 15;
  options.effort = 4.0;
  options.tolerance = 0.01;
  return options;
}

std::string ASolver() {
  for (const char* name : {"ipopt", "halfstep/barrier", "nlopt/ccsaq"}) {
    if (opt::MakeSolver(name)->available()) return name;
  }
  return "";
}

class OptimizerTest : public testing::Test {
 protected:
  const Experiment e_ = LoadExperiment("fig3_two_half_steps");
  const MarginEvaluator evaluator_{e_.robot, e_.scene, e_.config.smoothing.limits};
  const CertifiedFeasibility test_{evaluator_, {}};
};

TEST_F(OptimizerTest, IsNeverWorseThanTheDichotomyAndAllItAcceptsIsCertifiedOnItsOwn) {
  const SmoothingResult dichotomy =
      Smoothed(Dichotomy, ProblemOf(e_.sequence, test_), {.tolerance = 0.01});
  const CertifiedFeasibility independent(evaluator_, {});
  MarginEvaluator::Scratch scratch = evaluator_.MakeScratch();
  size_t walks = 0;
  for (const std::string& solver : {ASolver(), std::string("halfstep/sqp")}) {
    std::vector<HomotopyParameters> accepted;
    OptimizerOptions options = Quick(solver);
    options.rounds = 5;
    const auto keep = [&accepted](const HomotopyParameters& p) { accepted.push_back(p); };
    const SmoothingResult result =
        Smoothed(OptimizeOverlaps, ProblemOf(e_.sequence, test_), options, {.on_incumbent = keep});
    EXPECT_EQ(result.ending, opt::Ending::kLimit) << result.message;  // of rounds or effort
    EXPECT_LT(DurationOf(result.parameters), DurationOf(dichotomy.parameters) - 0.3) << solver;
    accepted.push_back(result.parameters);
    walks += accepted.size();
    for (const HomotopyParameters& parameters : accepted) {
      const SuperposedWalk walk(e_.sequence, parameters);
      EXPECT_EQ(independent.Check(walk, {0.0, walk.duration()}, &scratch).verdict,
                Verdict::kFeasible);
    }
    double incumbent = 1e9;
    for (const SmoothingIterate& iterate : result.iterates) {
      EXPECT_LE(iterate.incumbent_duration, incumbent + 1e-9);
      incumbent = iterate.incumbent_duration;
    }
  }
  EXPECT_GT(walks, 5u);
}

// The effort is just that of the dichotomy, so that none is left to call the solver with.
TEST_F(OptimizerTest, WithoutASearchItEndsWhereItBegan) {
  if (ASolver().empty()) GTEST_SKIP() << "no solver";
  const SmoothingResult dichotomy =
      Smoothed(Dichotomy, ProblemOf(e_.sequence, test_), {.tolerance = 0.001});
  OptimizerOptions options = Quick(ASolver());
  options.tolerance = 0.001;
  for (const bool by_dichotomy : {false, true}) {
    options.start = by_dichotomy ? SearchStart::kDichotomy : SearchStart::kTypical;
    options.effort = by_dichotomy ? dichotomy.work.effort() : 1e-6;
    const SmoothingResult result =
        Smoothed(OptimizeOverlaps, ProblemOf(e_.sequence, test_), options);
    EXPECT_EQ(result.ending, opt::Ending::kNotRun);
    EXPECT_THAT(result.message, testing::StartsWith("the effort of "));
    EXPECT_THAT(result.message,
                testing::EndsWith(" was used before " + ASolver() + " was called; the walk is " +
                                  (by_dichotomy ? "a dichotomy's" : "the planned motion")));
    EXPECT_TRUE(result.feasible);
    if (by_dichotomy) {
      EXPECT_LE(DurationOf(result.parameters), DurationOf(dichotomy.parameters));
    } else {
      EXPECT_EQ(result.parameters, PlannedMotion(e_.sequence));
    }
  }
}

TEST_F(OptimizerTest, WhereRoundsBeginIsTheCallersChoice) {
  const double planned = DurationOf(PlannedMotion(e_.sequence));
  for (const SearchStart start :
       {SearchStart::kTypical, SearchStart::kDichotomy, SearchStart::kPlanned}) {
    OptimizerOptions options = Quick("halfstep/sqp");
    options.rounds = 5;
    options.start = start;
    const SmoothingResult result =
        Smoothed(OptimizeOverlaps, ProblemOf(e_.sequence, test_), options);
    EXPECT_TRUE(HasOwnResult(result.ending)) << Name(start) << ": " << result.message;
    EXPECT_LT(DurationOf(result.parameters), 0.75 * planned) << Name(start);
  }
}

TEST_F(OptimizerTest, ASolverThatRefusesTheProgramIsNotCreditedWithTheDichotomysWalk) {
  if (!opt::MakeSolver("nlopt/bobyqa")->available()) GTEST_SKIP() << "no solver";
  const SmoothingResult dichotomy =
      Smoothed(Dichotomy, ProblemOf(e_.sequence, test_), {.tolerance = 0.01});
  for (const ProgramKind kind :
       {ProgramKind::kFastest, ProgramKind::kSmooth, ProgramKind::kSafest}) {
    OptimizerOptions options = Quick("nlopt/bobyqa");
    options.program.kind = kind;
    const SmoothingResult result =
        Smoothed(OptimizeOverlaps, ProblemOf(e_.sequence, test_), options);
    EXPECT_EQ(result.ending, opt::Ending::kInvalidInput) << result.message;
    // A dichotomy knows durations alone, so `smooth` has none.
    const bool planned = kind == ProgramKind::kSmooth;
    EXPECT_THAT(result.message,
                testing::HasSubstr(std::string("nlopt/bobyqa refused the program; nothing of its "
                                               "own was better and proved, the walk is ") +
                                   (planned ? "the planned motion" : "a dichotomy's")));
    EXPECT_TRUE(result.feasible);
    EXPECT_NEAR(DurationOf(result.parameters),
                DurationOf(planned ? PlannedMotion(e_.sequence) : dichotomy.parameters), 0.01);
  }
  SmoothingMonitor monitor;
  EXPECT_EQ(
      ParetoCurve(ProblemOf(e_.sequence, test_), Quick("nlopt/bobyqa"), {.points = 2}, monitor)
          .ending,
      opt::Ending::kInvalidInput);
}

// A walk of tests/fixtures/walk, smoothed.
struct SmoothedFixture {
  Experiment e;
  CertifiedFeasibility test{{e.robot, e.scene, e.config.smoothing.limits}, {}};
  SmoothingResult result;

  explicit SmoothedFixture(const std::string& name)
      : e(Prepare(LoadConfig(InSources("tests/fixtures/walk/") + name + ".yaml", {}))) {
    OptimizerOptions options = e.config.smoothing.options.Get(OptimizerGroup()).options;
    options.solver = "halfstep/sqp";
    options.effort = 20.0;
    result = Smoothed(OptimizeOverlaps, ProblemOf(e.sequence, test), options);
  }
};

// With a penalty of 2 throughout, points of every round stayed violated, and the walk was the
// dichotomy's of 13.48 s.
TEST(SlowArc, RowsWhoseMultipliersAreLargeAreKeptAllTheSame) {
  const SmoothedFixture fixture("slow_arc");
  const SmoothingResult& result = fixture.result;
  EXPECT_EQ(result.ending, opt::Ending::kLimit) << result.message;  // of rounds or effort
  EXPECT_LT(DurationOf(result.parameters), 8.5) << result.message;
}

// Searches from the dichotomy's walk and from the planned motion as it is end at 9.16 s, the best
// uniform choice of durations and heights at 8.96 s.
TEST(Turn, ShortHalfStepsAreFoundWhereLongOnesAreALocalOptimum) {
  const SmoothedFixture fixture("turn");
  const SmoothingResult& result = fixture.result;
  EXPECT_TRUE(HasOwnResult(result.ending)) << result.message;
  EXPECT_LT(DurationOf(result.parameters), 8.96) << result.message;
  MarginEvaluator::Scratch scratch = fixture.test.evaluator().MakeScratch();
  const SuperposedWalk walk(fixture.e.sequence, result.parameters);
  EXPECT_EQ(fixture.test.Check(walk, {0.0, walk.duration()}, &scratch).verdict, Verdict::kFeasible);
}

// Whatever a solver proposes is refused but the planned motion.
TEST_F(OptimizerTest, WithoutAProofOfAnythingNewItDidNotImprove) {
  const HomotopyParameters planned = PlannedMotion(e_.sequence);
  const FakeFeasibility nothing_else(evaluator_, [&](const HomotopyParameters& p) {
    return p == planned ? Verdict::kFeasible : Verdict::kViolated;
  });
  const SmoothingResult result =
      Smoothed(OptimizeOverlaps, ProblemOf(e_.sequence, nothing_else), Quick("halfstep/sqp"));
  EXPECT_EQ(result.ending, opt::Ending::kNoImprovement) << result.message;
  EXPECT_EQ(result.parameters, planned);
  EXPECT_THAT(result.message, testing::HasSubstr("the walk is a dichotomy's"));
}

TEST_F(OptimizerTest, StoppedAtAnyMomentItKeepsACertifiedWalk) {
  if (ASolver().empty()) GTEST_SKIP() << "no solver";
  MarginEvaluator::Scratch scratch = evaluator_.MakeScratch();
  for (const int moment : {0, 1, 3}) {  // how often it has told its progress
    std::stop_source source;
    int told = 0;
    const auto stop = [&](double) {
      if (++told == moment) source.request_stop();
    };
    if (moment == 0) source.request_stop();
    const SmoothingResult result =
        Smoothed(OptimizeOverlaps, ProblemOf(e_.sequence, test_), Quick(ASolver()),
                 {.progress = stop, .stop = source.get_token()});
    EXPECT_EQ(result.ending == opt::Ending::kNotRun, moment == 0) << result.message;
    EXPECT_THAT(result.ending, testing::AnyOf(opt::Ending::kNotRun, opt::Ending::kInterrupted,
                                              opt::Ending::kNoImprovement));
    EXPECT_THAT(result.message, testing::StartsWith("stopped from outside"));
    const SuperposedWalk walk(e_.sequence, result.parameters);
    EXPECT_EQ(test_.Check(walk, {0.0, walk.duration()}, &scratch).verdict, Verdict::kFeasible);
    EXPECT_LE(walk.duration(), DurationOf(PlannedMotion(e_.sequence)));
  }
}

// Once a candidate that misses what is demanded was "proved" with lowered demands, for want of a
// walk within the limit.
TEST_F(OptimizerTest, SafestWithinLessThanTheDichotomysDurationStillKeepsWhatIsDemanded) {
  if (ASolver().empty()) GTEST_SKIP() << "no solver";
  const SmoothingResult dichotomy =
      Smoothed(Dichotomy, ProblemOf(e_.sequence, test_), {.tolerance = 0.01});
  const double own = DurationOf(dichotomy.parameters);
  MarginEvaluator::Scratch scratch = evaluator_.MakeScratch();
  OptimizerOptions options = Quick(ASolver());
  options.program.kind = ProgramKind::kSafest;
  for (const double part : {0.75, 0.3}) {
    options.duration_limit = part * own;
    const SmoothingResult result =
        Smoothed(OptimizeOverlaps, ProblemOf(e_.sequence, test_), options);
    const SuperposedWalk walk(e_.sequence, result.parameters);
    EXPECT_EQ(test_.Check(walk, {0.0, walk.duration()}, &scratch).verdict, Verdict::kFeasible);
    // A third of the dichotomy's time is faster than the feet may move.
    EXPECT_EQ(std::isfinite(result.cost), part > 0.5) << result.message;
    if (std::isfinite(result.cost)) {
      EXPECT_LE(walk.duration(), options.duration_limit + 1e-9);
      EXPECT_LE(result.cost, 0.0);
    } else {
      EXPECT_EQ(result.parameters, dichotomy.parameters);
      EXPECT_THAT(result.message, testing::HasSubstr("no walk of at most"));
    }
  }
}

TEST_F(OptimizerTest, EveryPointOfAParetoCurveHoldsAtItsLevelAndSafetyGrowsWithTime) {
  if (ASolver().empty()) GTEST_SKIP() << "no solver";
  const WalkProblem problem = ProblemOf(e_.sequence, test_);
  SmoothingMonitor monitor;
  const SmoothingResult result = ParetoCurve(problem, Quick(ASolver()), {.points = 3}, monitor);
  EXPECT_TRUE(HasOwnResult(result.ending)) << result.message;
  ASSERT_GE(result.pareto.size(), 3u);
  MarginEvaluator::Scratch scratch = evaluator_.MakeScratch();
  for (size_t i = 0; i < result.pareto.size(); ++i) {
    const ParetoPoint& point = result.pareto[i];
    MarginLimits limits = evaluator_.limits();
    for (MarginFamily family : AllMarginFamilies()) {
      if (!Raised()[static_cast<size_t>(family)]) continue;
      limits.demanded_of(family) += point.least_slack * Scale(family);
    }
    const SuperposedWalk walk(e_.sequence, point.parameters);
    EXPECT_NEAR(walk.duration(), point.duration, 1e-9);
    const MarginEvaluator raised = evaluator_.WithLimits(limits);
    EXPECT_EQ(
        CertifiedFeasibility(raised, {}).Check(walk, {0.0, walk.duration()}, &scratch).verdict,
        Verdict::kFeasible);
    EXPECT_GE(point.least_slack, 0.0);
  }
  EXPECT_GT(result.pareto.back().least_slack, result.pareto.front().least_slack + 0.1);
}

TEST_F(OptimizerTest, AParetoCurveHasNoPointThatAShorterWalkIsAsSafeAs) {
  OptimizerOptions options = Quick("halfstep/sqp");
  options.effort = 8.0;
  SmoothingMonitor monitor;
  const SmoothingResult result =
      ParetoCurve(ProblemOf(e_.sequence, test_), options, {.points = 6}, monitor);
  ASSERT_GE(result.pareto.size(), 2u) << result.message;
  for (size_t i = 1; i < result.pareto.size(); ++i) {
    EXPECT_GT(result.pareto[i].duration, result.pareto[i - 1].duration);
    EXPECT_GT(result.pareto[i].least_slack, result.pareto[i - 1].least_slack);
  }
}

// All solves together: each having its own, every one of 42 looked at its start at least.
TEST_F(OptimizerTest, AParetoCurveHasOneEffort) {
  OptimizerOptions options = Quick("halfstep/sqp");
  options.effort = 1e-6;  // used before the first solve
  SmoothingMonitor monitor;
  const SmoothingResult none =
      ParetoCurve(ProblemOf(e_.sequence, test_), options, {.points = 40}, monitor);
  EXPECT_FALSE(HasOwnResult(none.ending)) << none.message;
  EXPECT_TRUE(none.feasible);
  EXPECT_THAT(none.message, testing::StartsWith("the effort of 1e-06 was used"));
  EXPECT_TRUE(none.pareto.empty());
  options.effort = 1.0;
  SmoothingMonitor other;
  const SmoothingResult result =
      ParetoCurve(ProblemOf(e_.sequence, test_), options, {.points = 40}, other);
  EXPECT_TRUE(result.feasible);
  EXPECT_LT(result.work.effort(), 1.5);
}

class ProgramDerivatives : public testing::TestWithParam<std::string> {};

// Along random directions at a random point. Clearances have kinks where the nearest feature
// changes; there differences with two steps disagree. In a straight walk with equal parameters
// whole edges are parallel to the bar, which is why the point is random.
TEST_P(ProgramDerivatives, AgreeWithDifferencesForEveryKind) {
  const Experiment e = LoadExperiment(GetParam());
  const MarginEvaluator evaluator(e.robot, e.scene, e.config.smoothing.limits);
  WalkDraw draw(370);
  for (ProgramKind kind : {ProgramKind::kFastest, ProgramKind::kSmooth, ProgramKind::kSafest}) {
    ProgramOptions options;
    options.kind = kind;
    options.parameters = {.heights = true, .durations = true};
    // Lower feet are out of reach there, of which only how far is known.
    options.parameters.bound("least_height_scale") = 0.2;
    options.weights = {0.05, 0.001, 0.02};
    options.watch.instants = 3;
    const OverlapProgram program(e.sequence, evaluator, options, 10.0);
    const opt::Problem problem = program.MakeProblem();
    Eigen::VectorXd x = program.ToVariables(draw.Parameters(e.sequence, 0.6, 0.85));
    const Eigen::VectorXd room = problem.upper() - problem.lower();
    x = x.cwiseMax(problem.lower() + 0.05 * room).cwiseMin(problem.upper() - 0.05 * room);
    Eigen::VectorXd direction(x.size());
    for (Eigen::Index v = 0; v < x.size(); ++v) direction[v] = draw.Uniform(-1, 1);
    const Eigen::VectorXd rows = problem.DenseJacobian(x) * direction;
    std::vector<double> nonzeros;  // in one pass
    EXPECT_EQ(problem.ConstraintsWithJacobian(x, &nonzeros), problem.Constraints(x));
    EXPECT_EQ(nonzeros, problem.Jacobian(x));
    const double cost = problem.Gradient(x).dot(direction);
    const auto slope = [&](double h) {
      return Eigen::VectorXd(
          (problem.Constraints(x + h * direction) - problem.Constraints(x - h * direction)) /
          (2 * h));
    };
    const Eigen::VectorXd coarse = slope(1e-5), fine = slope(2e-6);
    int kinks = 0, caught = 0;
    for (Eigen::Index r = 0; r < rows.size(); ++r) {
      const std::string name = problem.RowName(static_cast<int>(r));
      const double size = 1 + std::abs(fine[r]);
      if (name.find("clearance") != std::string::npos &&
          std::abs(coarse[r] - fine[r]) > 1e-3 * size) {
        ++kinks;
        continue;
      }
      EXPECT_NEAR(rows[r], fine[r], 5e-3 * size) << name;
      caught += std::abs(-rows[r] - fine[r]) > 5e-3 * size;
    }
    EXPECT_LE(kinks, rows.size() / 10);
    EXPECT_GT(caught, rows.size() / 20);
    const double h = 1e-5;
    EXPECT_NEAR(cost, (problem.Cost(x + h * direction) - problem.Cost(x - h * direction)) / (2 * h),
                1e-5 * (1 + std::abs(cost)))
        << Name(kind);
  }
}

std::vector<std::string> Configs() {
  if (kSanitized) return {"fig3_two_half_steps", "bar_8cm"};
  return {"fig3_two_half_steps", "bar_8cm", "fig4_raw_sequence"};
}

INSTANTIATE_TEST_SUITE_P(All, ProgramDerivatives, testing::ValuesIn(Configs()),
                         [](const auto& name) { return name.param; });

// Certifies, and refuses every walk of other durations than planned when asked about all of it.
class RefusesNewWholes : public FeasibilityTest {
 public:
  RefusesNewWholes(const FeasibilityTest& certified, std::vector<double> planned)
      : certified_(certified), planned_(std::move(planned)) {}

  Evidence evidence() const override { return Evidence::kCertified; }
  std::string Description() const override { return "refuses new wholes"; }
  const MarginEvaluator& evaluator() const override { return certified_.evaluator(); }
  std::unique_ptr<FeasibilityTest> Over(const MarginEvaluator&) const override { return nullptr; }
  Feasibility Check(const SuperposedWalk& walk, const TimeSpan& span,
                    MarginEvaluator::Scratch* scratch) const override {
    const bool whole = span.begin <= 0.0 && span.end >= walk.duration();
    if (whole && walk.parameters().durations != planned_) {
      return {Verdict::kUndecided, Evidence::kCertified, {}};
    }
    return certified_.Check(walk, span, scratch);
  }

 private:
  const FeasibilityTest& certified_;
  std::vector<double> planned_;
};

// Stretches were proved one after the other; what is returned is proved once more as a whole.
TEST_F(OptimizerTest, WhatCannotBeProvedAsAWholeIsNotReturned) {
  const std::vector<double> planned = PlannedMotion(e_.sequence).durations;
  const RefusesNewWholes test(test_, planned);
  OptimizerOptions options = Quick("halfstep/sqp");
  int accepted = 0;
  const auto count = [&](const HomotopyParameters& p) { accepted += p.durations != planned; };
  const SmoothingResult result =
      Smoothed(OptimizeOverlaps, ProblemOf(e_.sequence, test), options, {.on_incumbent = count});
  EXPECT_GT(accepted, 0);
  EXPECT_EQ(result.parameters.durations, planned);
}

// `safest` never trades what is demanded away: a walk of less slack costs infinitely much.
TEST_F(OptimizerTest, SafestRefusesWalksBelowWhatIsDemanded) {
  const HomotopyParameters planned = PlannedMotion(e_.sequence);
  HomotopyParameters too_far = planned;
  for (double& overlap : too_far.overlaps) overlap = 0.0;
  for (double& duration : too_far.durations) duration *= 0.3;  // the ZMP's bumps leave the soles
  ProgramOptions options;
  options.kind = ProgramKind::kSafest;
  const OverlapProgram program(e_.sequence, evaluator_, options, 1e3);
  ASSERT_GT(program.Cost(too_far), 0.0);
  ASSERT_LT(program.Cost(planned), 0.0);
  for (const bool within : {false, true}) {
    const Incumbent::Rules rules = SafestRules(program, test_, within);
    EXPECT_TRUE(std::isinf(rules.cost(too_far))) << within;
    EXPECT_LE(rules.cost(planned), 0.0);
  }
}

// CoM and ZMP may rest nearer to the other foot, step by step.
TEST(OptimizerScenario, SupportPointsShortenAWalkOverABar) {
  Experiment e = LoadExperiment("bar_8cm");
  e.config.footsteps.resize(4);
  e = Prepare(e.config);
  const MarginEvaluator evaluator(e.robot, e.scene, e.config.smoothing.limits);
  const CertifiedFeasibility test(evaluator, {});
  double durations[2];
  for (const bool points : {false, true}) {
    OptimizerOptions options;
    options.solver = "halfstep/sqp";
    options.program.parameters = {.heights = true, .durations = true, .support_points = points};
    options.rounds = 6;
    options.effort = 10.0;
    options.tolerance = 0.02;
    const WalkProblem problem = ProblemOf(e.sequence, test);
    const SmoothingResult result = Smoothed(OptimizeOverlaps, problem, options);
    durations[points] = DurationOf(result.parameters);
    const SuperposedWalk walk(e.sequence, result.parameters);
    MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
    EXPECT_EQ(test.Check(walk, {0.0, walk.duration()}, &scratch).verdict, Verdict::kFeasible);
    const ParameterTable table = problem.Parameters(options.program.parameters);
    double moved = 0.0;
    for (int step = 0; step < e.sequence.num_steps(); ++step) {
      const HomotopyParameter point{ParameterFamily::kSupportPoint, step};
      const double s = point.in(result.parameters);
      EXPECT_GE(s, table.row(point).lower - 1e-12);
      EXPECT_LE(s, table.row(point).upper + 1e-12);
      moved = std::max(moved, std::abs(s));
    }
    if (points) {
      EXPECT_GE(moved, 0.01);
    } else {
      EXPECT_EQ(moved, 0.0);
    }
  }
  EXPECT_LE(durations[1], 0.97 * durations[0]);
}

}  // namespace
}  // namespace halfstep
