// The one loop of searches, over a range of half-steps, and the stages that a search is made of.

#include "smoothing/methods/search_stages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "opt/adapters/solver_registry.h"
#include "smoothing/methods/accepted_in_parts.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/scenarios/load_experiment.h"
#include "tests/scenarios/straight_walk.h"
#include "tests/scenarios/stubborn.h"
#include "tests/smoothing/smoothed.h"

namespace halfstep {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

RangeOptions BySqp(const ParameterChoice& choice) {
  RangeOptions options;
  options.solver = opt::MakeSolver("halfstep/sqp");
  options.program.parameters = choice;
  return options;
}

class StagesTest : public testing::Test {
 protected:
  // What stages make of the planned motion, and every incumbent on the way.
  struct Found {
    SmoothingResult result;
    std::vector<HomotopyParameters> incumbents = {};
    bool own = false;
    std::string sentence = {};
  };
  Found Run(const WalkProblem& problem, const std::vector<SearchStage>& stages,
            double effort = kNoLimit, SearchStart start = SearchStart::kTypical) const {
    Found found;
    SmoothingMonitor monitor(
        {.on_incumbent = [&found](const HomotopyParameters& p) { found.incumbents.push_back(p); }});
    EXPECT_TRUE(monitor.BeginFeasibly(problem, problem.Start()));
    SearchEnding ending{.solver = "halfstep/sqp"};
    found.own = RunStages(problem, stages, start, BySqp({.heights = true, .durations = true}),
                          effort, monitor, &ending);
    EXPECT_EQ(found.own, monitor.incumbent() != problem.Start());
    ending.own = found.own;
    found.sentence = ending.Sentence();
    found.result = monitor.Finish(ending.Ending(), found.sentence);
    return found;
  }
  bool Holds(const HalfStepSequence& sequence, const HomotopyParameters& parameters) const {
    MarginEvaluator::Scratch scratch = test_.evaluator().MakeScratch();
    const SuperposedWalk walk(sequence, parameters);
    return test_.Check(walk, {0.0, walk.duration()}, &scratch).verdict == Verdict::kFeasible;
  }

  const Experiment e_ = LoadExperiment("fig3_two_half_steps");
  const CertifiedFeasibility test_{{e_.robot, Scene{}, e_.config.smoothing.limits}, {}};
};

TEST(SearchStart, HasNames) {
  std::set<std::string_view> names;
  for (SearchStart start :
       {SearchStart::kTypical, SearchStart::kDichotomy, SearchStart::kPlanned}) {
    names.insert(Name(start));
  }
  EXPECT_THAT(names, testing::ElementsAre("dichotomy", "planned", "typical"));
}

// Each window shortens its own half-steps, the whole what windows leave, and nothing is lost
// between them.
TEST_F(StagesTest, GoAlongALongWalkByWindowsAndThenOverTheWhole) {
  const HalfStepSequence sequence = StraightWalk(e_, 16);  // 32 half-steps
  const WalkProblem problem = ProblemOf(sequence, test_);
  const HomotopyParameters planned = problem.Start();
  const SearchStage windows{.window = 12, .step = 8, .rounds = 6};
  const Found by_windows = Run(problem, {windows});
  EXPECT_TRUE(by_windows.own) << by_windows.sentence;
  EXPECT_TRUE(Holds(sequence, by_windows.result.parameters));
  for (int first = 0; first < sequence.size(); first += 8) {
    const auto begin = by_windows.result.parameters.durations.begin() + first;
    EXPECT_LT(*std::min_element(begin, begin + 8), 0.95 * planned.durations[0]) << first;
  }
  const double effort = by_windows.result.work.effort();
  const Found both = Run(problem, {windows, {.rounds = 3}}, effort + 1.5);
  EXPECT_TRUE(Holds(sequence, both.result.parameters));
  EXPECT_LE(both.result.cost, by_windows.result.cost + 1e-9) << both.sentence;
  EXPECT_GE(both.result.work.effort(), effort);
  EXPECT_LT(both.result.work.effort(), effort + 3.0) << "a round over the whole is finished";
  EXPECT_GE(both.incumbents.size(), by_windows.incumbents.size());
  // The search by windows is the same, whatever follows.
  for (size_t i = 0; i < by_windows.incumbents.size(); ++i) {
    ASSERT_EQ(both.incumbents[i], by_windows.incumbents[i]) << i;
  }
}

TEST_F(StagesTest, EndWhereTheirEffortIsUsed) {
  const HalfStepSequence sequence = StraightWalk(e_, 16);
  const WalkProblem problem = ProblemOf(sequence, test_);
  const std::vector<SearchStage> stages = {{.window = 12, .step = 8}, {}};
  const Found none = Run(problem, stages, 0.0);
  EXPECT_FALSE(none.own);
  EXPECT_EQ(none.result.parameters, problem.Start());
  const double begun = none.result.work.effort();  // the plan's proof
  const Found little = Run(problem, stages, begun + 0.02);
  EXPECT_GE(little.result.work.effort(), begun + 0.02);
  EXPECT_LT(little.result.work.effort(), begun + 1.0) << "a round in a window is finished";
  EXPECT_EQ(little.result.parameters.durations.back(), problem.Start().durations.back())
      << "no window came so far";
}

// A gain of a window that the whole walk refuses costs the steps around the refusal.
TEST_F(StagesTest, WhatTheWholeRefusesCostsNothingElsewhere) {
  const HalfStepSequence sequence = StraightWalk(e_, 8);
  const Stubborn stubborn(test_, sequence.half_steps[3], sequence.size());
  const Found found = Run(ProblemOf(sequence, stubborn), {{.window = 4, .step = 4, .rounds = 6}});
  const std::vector<double> planned = PlannedMotion(sequence).durations;
  const std::vector<double>& T = found.result.parameters.durations;
  EXPECT_EQ(T[3], planned[3]);
  // T of one half-step says little: where its overlap grows along, it costs nothing.
  const SuperposedWalk walk(sequence, found.result.parameters);
  for (const int k : {8, 10, 12}) {
    EXPECT_LT(walk.start_of(k + 2) - walk.start_of(k), 0.95 * (planned[k] + planned[k + 1])) << k;
  }
  EXPECT_LT(walk.duration() - walk.start_of(14), 0.95 * (planned[14] + planned[15]));
  EXPECT_TRUE(Holds(sequence, found.result.parameters));
}

TEST_F(StagesTest, BeginWhereTheyAreTold) {
  const WalkProblem problem = ProblemOf(e_.sequence, test_);
  for (const SearchStart start : {SearchStart::kTypical, SearchStart::kPlanned}) {
    const Found found = Run(problem, {{.rounds = 1}}, 1.0, start);
    ASSERT_FALSE(found.result.iterates.empty());
    // The first point of the first solve is where rounds begin.
    const double first = found.result.iterates.front().candidate_duration;
    if (start == SearchStart::kPlanned) {
      EXPECT_NEAR(first, DurationOf(problem.Start()), 1e-9);
    } else {
      EXPECT_LT(first, 0.8 * DurationOf(problem.Start()));
    }
  }
}

class RangeTest : public StagesTest {
 protected:
  RangeTest() {
    for (double& T : slow_.durations) T *= 1.5;
  }
  struct Gains {
    std::vector<double> gains;
    std::vector<HomotopyParameters> parts;
    bool more = false, moves = false;
    Work work;
  };
  Gains Search(const WalkWindow& window, const RangeOptions& options,
               double effort = kNoLimit) const {
    Gains found;
    SmoothingMonitor monitor;
    monitor.BeginAccepted(window.problem, AcceptedInParts::Walk(window.parameters));
    SearchEnding ending;
    RangeSearch search(
        window, options, monitor,
        [&found](const HomotopyParameters& part, double, double gain) {
          found.parts.push_back(part);
          found.gains.push_back(gain);
        },
        &ending);
    found.moves = search.moves();
    if (found.moves) found.more = search.From(window.parameters, 1.0, effort);
    found.work = monitor.work();
    return found;
  }

  const HalfStepSequence sequence_ = StraightWalk(e_, 4);
  HomotopyParameters slow_ = PlannedMotion(sequence_);  // all of it slower
};

// Regression: where half-steps were planned slow, windows ended while each round still gained.
TEST_F(RangeTest, GoesOnWhereRoundsStillGain) {
  const WalkWindow window = WindowOf(ProblemOf(sequence_, test_), slow_, 0, 3);
  RangeOptions options = BySqp(EveryFamily());
  options.rounds = 1;
  const Gains few = Search(window, options);
  options.rounds = 8;
  const Gains many = Search(window, options);
  EXPECT_TRUE(few.more);
  ASSERT_FALSE(many.gains.empty());
  EXPECT_GT(many.gains.back(), (few.gains.empty() ? 0.0 : few.gains.back()) + 0.1);
  EXPECT_GT(many.work.effort(), few.work.effort());
}

TEST_F(RangeTest, TellsEveryGainAndThatItIsProved) {
  const WalkWindow window = WindowOf(ProblemOf(sequence_, test_), slow_, 2, 5);
  RangeOptions options = BySqp({.heights = true, .durations = true});
  options.rounds = 8;
  const Gains found = Search(window, options);
  ASSERT_GT(found.gains.size(), 1u);
  for (size_t i = 0; i < found.gains.size(); ++i) {
    EXPECT_GT(found.gains[i], i == 0 ? 0.0 : found.gains[i - 1]);
    EXPECT_NEAR(found.gains[i], DurationOf(window.parameters) - DurationOf(found.parts[i]), 1e-9);
    HomotopyParameters walk = slow_;
    window.Paste(found.parts[i], &walk);
    EXPECT_TRUE(Holds(sequence_, walk));
  }
  // With the first proof of an end as it is, rounds are over.
  options.first_proof = true;
  const Gains first = Search(window, options);
  ASSERT_FALSE(first.gains.empty());
  EXPECT_LE(first.gains.size(), found.gains.size());
  EXPECT_LT(first.work.effort(), found.work.effort());
}

TEST_F(RangeTest, EndsWhereTheEffortIsUsed) {
  const WalkWindow window = WindowOf(ProblemOf(sequence_, test_), slow_, 0, 3);
  const RangeOptions options = BySqp({.heights = true, .durations = true});
  const Gains whole = Search(window, options);
  EXPECT_TRUE(whole.more);
  const double part = 0.3 * whole.work.effort();
  const Gains cut = Search(window, options, part);
  EXPECT_FALSE(cut.more);
  EXPECT_GE(cut.work.effort(), part);
  EXPECT_LT(cut.work.effort(), whole.work.effort());
  ASSERT_LE(cut.gains.size(), whole.gains.size());
  // What comes before the cut is the same.
  for (size_t i = 0; i < cut.parts.size(); ++i) EXPECT_EQ(cut.parts[i], whole.parts[i]) << i;
}

TEST_F(RangeTest, WhatIsFixedDoesNotMove) {
  std::vector<FixedParameter> fixed;
  const ParameterTable table(sequence_, {}, {.durations = true});
  for (const ParameterRow& row : table.rows()) {
    if (!row.fixed) fixed.push_back({row.parameter, row.start});
  }
  const WalkProblem problem = ProblemOf(sequence_, test_, fixed);
  EXPECT_FALSE(Search(WholeRange(problem, problem.Start()), BySqp({.durations = true})).moves);
}

}  // namespace
}  // namespace halfstep
