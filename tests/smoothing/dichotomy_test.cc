// The bisection itself, with feasibility given by a rule on the overlaps.

#include "smoothing/methods/dichotomy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <stop_token>

#include "smoothing/methods/accepted_in_parts.h"
#include "tests/smoothing/fake_feasibility.h"
#include "tests/smoothing/smoothed.h"
#include "tests/smoothing/test_walks.h"

namespace halfstep {
namespace {

using Order = DichotomyOptions::Order;

class DichotomyTest : public testing::Test {
 protected:
  // Feasible while every overlap is at most `limit` [s].
  FakeFeasibility UpTo(double limit) const {
    return Rule([limit](const HomotopyParameters& p) {
      const bool ok = *std::max_element(p.overlaps.begin(), p.overlaps.end()) <= limit;
      return ok ? Verdict::kFeasible : Verdict::kViolated;
    });
  }
  FakeFeasibility Rule(FakeFeasibility::Rule rule) const { return {evaluator_, std::move(rule)}; }
  double Bound(int junction) const {
    return NaturalOverlapBound(PlannedMotion(sequence_), junction);
  }

  const MarginEvaluator evaluator_{Hrp2(), {}, {}};
  const HalfStepSequence sequence_ = WalkDraw(80).Sequence(3);  // 5 junctions, bounds above 0.3 s
  const DichotomyOptions options_;
};

TEST_F(DichotomyTest, FindsTheLimitFromBelowWithinTheToleranceInEitherOrderAndAnyPasses) {
  for (double limit : {0.3, 0.25, 0.1234, 0.002}) {
    for (double tolerance : {0.05, 0.001, 1e-6}) {
      for (Order order : {Order::kLeftToRight, Order::kRightToLeft}) {
        for (int passes : {1, 2, 3}) {
          const FakeFeasibility test = UpTo(limit);
          const DichotomyOptions options{.tolerance = tolerance, .order = order, .passes = passes};
          const SmoothingResult result = Smoothed(Dichotomy, ProblemOf(sequence_, test), options);
          const bool moved = result.parameters != PlannedMotion(sequence_);
          EXPECT_EQ(result.ending, moved ? opt::Ending::kConverged : opt::Ending::kNoImprovement);
          EXPECT_TRUE(moved || limit < tolerance);
          EXPECT_EQ(result.evidence, Evidence::kCertified);
          for (size_t i = 0; i < 5; ++i) {
            EXPECT_LE(result.parameters.overlaps[i], limit);
            EXPECT_GT(result.parameters.overlaps[i], limit - tolerance);
            EXPECT_EQ(result.junctions[i].overlap, result.parameters.overlaps[i]);
            EXPECT_TRUE(result.junctions[i].limited_by);
          }
          EXPECT_EQ(result.parameters.durations, PlannedMotion(sequence_).durations);
          EXPECT_EQ(result.parameters.height_scales, PlannedMotion(sequence_).height_scales);
        }
      }
    }
  }
}

// Whatever the cheaper test overlooks, nothing is taken that the problem's test did not accept.
TEST_F(DichotomyTest, ACheaperTestSavesQuestionsAndChangesNothingElse) {
  for (const double limit : {0.3, 0.1234, 0.0}) {
    for (const double overlooked : {0.0, 0.004, 1.0}) {
      DichotomyOptions options{.tolerance = 0.001};
      const FakeFeasibility alone = UpTo(limit), test = UpTo(limit);
      const SmoothingResult slow = Smoothed(Dichotomy, ProblemOf(sequence_, alone), options);
      options.cheaper = std::make_shared<FakeFeasibility>(UpTo(limit + overlooked));
      const SmoothingResult quick = Smoothed(Dichotomy, ProblemOf(sequence_, test), options);
      for (size_t i = 0; i < 5; ++i) {
        EXPECT_LE(quick.parameters.overlaps[i], limit);
        EXPECT_NEAR(quick.parameters.overlaps[i], slow.parameters.overlaps[i], options.tolerance);
        EXPECT_EQ(quick.junctions[i].limited_by.has_value(),
                  slow.junctions[i].limited_by.has_value());
      }
      if (overlooked == 0.0) {
        EXPECT_EQ(quick.parameters, slow.parameters);
      }
    }
  }
}

// The start is the caller's responsibility; nothing else is accepted unseen.
TEST_F(DichotomyTest, AStartThatIsKnownToBeFeasibleIsNotChecked) {
  const FakeFeasibility nothing =
      Rule([](const HomotopyParameters&) { return Verdict::kViolated; });
  const DichotomyOptions options{.accepted_start = AcceptedInParts::Walk(PlannedMotion(sequence_))};
  const SmoothingResult result = Smoothed(Dichotomy, ProblemOf(sequence_, nothing), options);
  EXPECT_EQ(result.parameters, PlannedMotion(sequence_));
  EXPECT_EQ(result.ending, opt::Ending::kNoImprovement);
}

TEST_F(DichotomyTest, WhenNoOverlapIsFeasibleItStaysExactlyZero) {
  const FakeFeasibility test = UpTo(0.0);
  const SmoothingResult result =
      Smoothed(Dichotomy, ProblemOf(sequence_, test), {.tolerance = 0.05});
  EXPECT_EQ(result.ending, opt::Ending::kNoImprovement);
  EXPECT_TRUE(result.feasible);
  EXPECT_EQ(result.parameters, PlannedMotion(sequence_));
  EXPECT_FALSE(result.time_to_first_improvement);
  for (const SmoothingIterate& iterate : result.iterates) EXPECT_FALSE(iterate.accepted);
}

TEST_F(DichotomyTest, WhenEverythingIsFeasibleItTakesTheBoundsInOneQuestionEach) {
  const FakeFeasibility test = UpTo(100);
  const SmoothingResult result =
      Smoothed(Dichotomy, ProblemOf(sequence_, test), {.up_down_cap = 0.8, .down_up_cap = 0.5});
  for (int i = 0; i < 5; ++i) {
    const JunctionResult& junction = result.junctions[static_cast<size_t>(i)];
    const double cap = i % 2 == 0 ? 0.8 : 0.5;
    EXPECT_EQ(junction.overlap, cap * Bound(i));
    EXPECT_EQ(junction.upper_bound, cap * Bound(i));
    EXPECT_EQ(junction.kind, KindOfJunction(i));
    EXPECT_FALSE(junction.limited_by);
  }
  EXPECT_EQ(test.questions.size(), 1u + 5u);
  EXPECT_EQ(result.iterates.size(), 5u);
}

TEST_F(DichotomyTest, WithCapsOfZeroNothingIsTried) {
  const FakeFeasibility test = UpTo(100);
  const SmoothingResult result =
      Smoothed(Dichotomy, ProblemOf(sequence_, test), {.up_down_cap = 0.0, .down_up_cap = 0.0});
  EXPECT_EQ(result.ending, opt::Ending::kNoImprovement);
  EXPECT_TRUE(result.feasible);
  EXPECT_EQ(result.parameters, PlannedMotion(sequence_));
  EXPECT_EQ(test.questions.size(), 1u);
}

TEST_F(DichotomyTest, AsksNoMoreThanBisectionNeedsAndOnlyAboutTheStretchThatChanges) {
  const FakeFeasibility test = UpTo(0.3);
  const SmoothingResult result =
      Smoothed(Dichotomy, ProblemOf(sequence_, test), {.tolerance = 0.001});
  size_t allowed = 1;
  for (int i = 0; i < 5; ++i) {
    allowed += 1 + static_cast<size_t>(std::ceil(std::log2(Bound(i) / 0.001)));
  }
  EXPECT_LE(test.questions.size(), allowed);
  const SuperposedWalk planned(sequence_, PlannedMotion(sequence_));
  EXPECT_EQ(test.questions[0].span.begin, 0.0);
  EXPECT_EQ(test.questions[0].span.end, planned.duration());
  HomotopyParameters incumbent = PlannedMotion(sequence_);
  size_t junction = 0;
  for (size_t k = 1; k < test.questions.size(); ++k) {
    const auto& question = test.questions[k];
    // One overlap differs from what was accepted last; junctions come in their order.
    size_t changed = 0, which = 0;
    for (size_t i = 0; i < 5; ++i) {
      if (question.parameters.overlaps[i] == incumbent.overlaps[i]) continue;
      ++changed;
      which = i;
    }
    ASSERT_EQ(changed, 1u);
    EXPECT_GE(which, junction);
    junction = which;
    const SuperposedWalk walk(sequence_, question.parameters);
    const int i = static_cast<int>(which);
    EXPECT_EQ(question.span.begin, std::nextafter(walk.start_of(i + 1), -1.0));
    EXPECT_EQ(question.span.end, walk.end_of(i));
    EXPECT_GT(question.span.end, question.span.begin);
    if (question.verdict == Verdict::kFeasible) incumbent = question.parameters;
  }
  EXPECT_EQ(incumbent, result.parameters);
}

TEST_F(DichotomyTest, UndecidedIsNotAccepted) {
  const FakeFeasibility test = Rule([](const HomotopyParameters& p) {
    return p.overlaps[0] <= 0.2 ? Verdict::kFeasible : Verdict::kUndecided;
  });
  const SmoothingResult result = Smoothed(Dichotomy, ProblemOf(sequence_, test), options_);
  EXPECT_LE(result.parameters.overlaps[0], 0.2);
  EXPECT_GT(result.parameters.overlaps[0], 0.199);
  const FakeFeasibility never = Rule([](const HomotopyParameters&) { return Verdict::kUndecided; });
  EXPECT_EQ(Smoothed(Dichotomy, ProblemOf(sequence_, never), options_).ending,
            opt::Ending::kNotRun);
}

TEST_F(DichotomyTest, AFinerToleranceIsNeverWorse) {
  for (double limit : {0.3, 0.17}) {
    double duration = std::numeric_limits<double>::infinity();
    for (double tolerance : {0.1, 0.05, 0.01, 0.001, 1e-5}) {
      const FakeFeasibility test = UpTo(limit);
      const SmoothingResult result =
          Smoothed(Dichotomy, ProblemOf(sequence_, test), {.tolerance = tolerance});
      const double now = SuperposedWalk(sequence_, result.parameters).duration();
      EXPECT_LE(now, duration + 1e-12);
      duration = now;
    }
  }
}

// Neighbours share what there is: what one takes the other lacks.
TEST_F(DichotomyTest, WithSharedLimitsTheOrderDecidesWhoTakesItAndLaterPassesLoseNothing) {
  const auto shared = [](const HomotopyParameters& p) {
    for (size_t i = 0; i + 1 < p.overlaps.size(); ++i) {
      if (p.overlaps[i] + p.overlaps[i + 1] > 0.3) return Verdict::kViolated;
    }
    return Verdict::kFeasible;
  };
  for (Order order : {Order::kLeftToRight, Order::kRightToLeft}) {
    double total = 0;
    for (int passes : {1, 2}) {
      const FakeFeasibility test = Rule(shared);
      const SmoothingResult result =
          Smoothed(Dichotomy, ProblemOf(sequence_, test),
                   {.tolerance = 1e-4, .order = order, .passes = passes});
      EXPECT_EQ(shared(result.parameters), Verdict::kFeasible);
      const auto& overlaps = result.parameters.overlaps;
      EXPECT_NEAR(overlaps[order == Order::kLeftToRight ? 0 : 4], 0.3, 1e-4);
      EXPECT_LT(overlaps[order == Order::kLeftToRight ? 1 : 3], 1e-4 * passes + 1e-9);
      const double now = std::accumulate(overlaps.begin(), overlaps.end(), 0.0);
      EXPECT_GE(now, total);
      total = now;
    }
  }
}

TEST_F(DichotomyTest, IteratesTellTheStoryAndTheIncumbentNeverGetsSlower) {
  const FakeFeasibility test = UpTo(0.3);
  const SmoothingResult result =
      Smoothed(Dichotomy, ProblemOf(sequence_, test), {.tolerance = 0.01, .passes = 2});
  double incumbent = SuperposedWalk(sequence_, PlannedMotion(sequence_)).duration();
  long instants = 1;  // the start's
  double wall = 0;
  int accepted = 0;
  ASSERT_EQ(result.iterates.size() + 1, test.questions.size());
  for (size_t k = 0; k < result.iterates.size(); ++k) {
    const SmoothingIterate& iterate = result.iterates[k];
    const auto& question = test.questions[k + 1];
    EXPECT_EQ(iterate.accepted, question.verdict == Verdict::kFeasible);
    EXPECT_NEAR(iterate.candidate_duration,
                SuperposedWalk(sequence_, question.parameters).duration(), 1e-12);
    EXPECT_LT(iterate.candidate_duration, incumbent + 1e-12);
    EXPECT_LE(iterate.incumbent_duration, incumbent + 1e-12);
    EXPECT_EQ(iterate.instants, ++instants);
    EXPECT_GE(iterate.wall, wall);
    EXPECT_EQ(iterate.lambda, iterate.accepted ? 1.0 : 0.0);
    if (iterate.accepted) {
      ++accepted;
      EXPECT_EQ(iterate.incumbent_duration, iterate.candidate_duration);
      EXPECT_FALSE(iterate.candidate_worst_margin);
    } else {
      EXPECT_NEAR(iterate.incumbent_duration, incumbent, 1e-12);
      ASSERT_TRUE(iterate.candidate_worst_margin);
      EXPECT_NEAR(*iterate.candidate_worst_margin, (-0.02 - 0.01) / 0.01, 1e-12);
    }
    incumbent = iterate.incumbent_duration;
    wall = iterate.wall;
  }
  EXPECT_GT(accepted, 5);
  EXPECT_NEAR(SuperposedWalk(sequence_, result.parameters).duration(), incumbent, 1e-12);
  EXPECT_TRUE(result.time_to_first_improvement);
  EXPECT_EQ(result.work.evaluated(), instants);
}

TEST_F(DichotomyTest, AJunctionIsLimitedByWhatRefusedTheSmallestInfeasibleOverlap) {
  const FakeFeasibility test = UpTo(0.3);
  const SmoothingResult result =
      Smoothed(Dichotomy, ProblemOf(sequence_, test), {.tolerance = 0.001});
  for (size_t i = 0; i < 5; ++i) {
    double smallest = std::numeric_limits<double>::infinity();
    double witness = 0;
    for (size_t k = 0; k < test.questions.size(); ++k) {
      const auto& question = test.questions[k];
      const double overlap = question.parameters.overlaps[i];
      if (question.verdict == Verdict::kFeasible || overlap <= 0.3 || overlap >= smallest) continue;
      smallest = overlap;
      witness = static_cast<double>(k + 1);
    }
    ASSERT_TRUE(result.junctions[i].limited_by);
    EXPECT_EQ(result.junctions[i].limited_by->t, witness);
  }
}

TEST_F(DichotomyTest, AnInfeasibleStartIsToldInASentenceAndLeftAlone) {
  const FakeFeasibility test = UpTo(-1.0);
  const SmoothingResult result = Smoothed(Dichotomy, ProblemOf(sequence_, test), options_);
  EXPECT_EQ(result.ending, opt::Ending::kNotRun);
  EXPECT_FALSE(result.feasible);
  EXPECT_NE(result.message.find("the planned motion is not feasible: zmp of"), std::string::npos)
      << result.message;
  EXPECT_EQ(result.parameters, PlannedMotion(sequence_));
  EXPECT_TRUE(result.iterates.empty());
  EXPECT_EQ(test.questions.size(), 1u);
}

TEST_F(DichotomyTest, StoppedAtAnyQuestionItReturnsTheLastAcceptedParameters) {
  const size_t full = [&] {
    const FakeFeasibility test = UpTo(0.3);
    Smoothed(Dichotomy, ProblemOf(sequence_, test), {.tolerance = 0.01});
    return test.questions.size();
  }();
  for (size_t stop_after = 1; stop_after + 1 < full; ++stop_after) {
    std::stop_source source;
    size_t asked = 0;
    HomotopyParameters last = PlannedMotion(sequence_);
    const FakeFeasibility test = Rule([&](const HomotopyParameters& p) {
      if (++asked >= stop_after) source.request_stop();
      const bool ok = *std::max_element(p.overlaps.begin(), p.overlaps.end()) <= 0.3;
      if (ok) last = p;
      return ok ? Verdict::kFeasible : Verdict::kViolated;
    });
    const SmoothingResult result = Smoothed(Dichotomy, ProblemOf(sequence_, test),
                                            {.tolerance = 0.01}, {.stop = source.get_token()});
    EXPECT_EQ(result.ending, last != PlannedMotion(sequence_) ? opt::Ending::kInterrupted
                             : result.iterates.empty()        ? opt::Ending::kNotRun
                                                              : opt::Ending::kNoImprovement);
    EXPECT_TRUE(result.feasible);
    EXPECT_FALSE(result.message.empty());
    EXPECT_EQ(result.parameters, last);
    EXPECT_LE(test.questions.size(), stop_after + 1);
    for (size_t i = 0; i < 5; ++i) {
      EXPECT_EQ(result.junctions[i].overlap, result.parameters.overlaps[i]);
    }
  }
}

TEST_F(DichotomyTest, ProgressRisesToOneByJunctions) {
  const FakeFeasibility test = UpTo(0.3);
  std::vector<double> told;
  Smoothed(Dichotomy, ProblemOf(sequence_, test), {.tolerance = 0.05, .passes = 2},
           {.progress = [&](double fraction) { told.push_back(fraction); }});
  ASSERT_EQ(told.size(), 10u);
  for (size_t i = 0; i < told.size(); ++i) {
    EXPECT_NEAR(told[i], 0.1 * static_cast<double>(i + 1), 1e-12);
  }
}

TEST_F(DichotomyTest, RefusesOptionsThatMeanNothing) {
  const FakeFeasibility test = UpTo(0.3);
  for (const DichotomyOptions& options :
       {DichotomyOptions{.tolerance = 0}, DichotomyOptions{.passes = -1},
        DichotomyOptions{.up_down_cap = 1.1}, DichotomyOptions{.down_up_cap = -0.1}}) {
    EXPECT_THROW(Smoothed(Dichotomy, ProblemOf(sequence_, test), options), std::logic_error);
  }
}

}  // namespace
}  // namespace halfstep
