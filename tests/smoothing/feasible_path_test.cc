#include "smoothing/feasible_path.h"

#include <gtest/gtest.h>

#include <limits>

#include "smoothing/overlap_program.h"
#include "tests/smoothing/fake_feasibility.h"
#include "tests/smoothing/test_walks.h"

namespace halfstep {
namespace {

class FeasiblePathTest : public testing::Test {
 protected:
  FeasiblePath Path(const FakeFeasibility& test, const HomotopyParameters& start) const {
    return {sequence_,
            {.cost = [](const HomotopyParameters& p) { return DurationOf(p); },
             .prove =
                 [&test](const SuperposedWalk& walk, double, const HomotopyParameters& incumbent,
                         MarginEvaluator::Scratch* scratch) {
                   return CheckChanges(test, walk, incumbent, scratch);
                 }},
            start,
            DurationOf(start),
            evaluator_.MakeScratch()};
  }
  // Feasible while the first overlap is at most `limit` [s].
  FakeFeasibility UpTo(double limit) const {
    return {evaluator_, [limit](const HomotopyParameters& p) {
              return p.overlaps[0] <= limit ? Verdict::kFeasible : Verdict::kViolated;
            }};
  }

  const MarginEvaluator evaluator_{Hrp2(), {}, {}};
  const HalfStepSequence sequence_ = WalkDraw(80).Sequence(2);
  const HomotopyParameters planned_ = PlannedMotion(sequence_);
};

TEST_F(FeasiblePathTest, AProvedCandidateBecomesTheIncumbentAtOnce) {
  const FakeFeasibility test = UpTo(100);
  FeasiblePath path = Path(test, planned_);
  const HomotopyParameters candidate = Overlapped(sequence_, 0.5);
  EXPECT_EQ(path.Toward(candidate, 5), 1.0);
  EXPECT_EQ(path.incumbent(), candidate);
  EXPECT_EQ(path.cost(), DurationOf(candidate));
  EXPECT_EQ(path.accepted(), 1);
  EXPECT_FALSE(path.refusal());
  // What costs more, or as much, is not even asked about.
  const size_t asked = test.questions.size();
  EXPECT_EQ(path.Toward(planned_, 5), 0.0);
  EXPECT_EQ(path.Toward(candidate, 5), 0.0);
  EXPECT_EQ(test.questions.size(), asked);
  EXPECT_EQ(path.incumbent(), candidate);
}

TEST_F(FeasiblePathTest, ARefusedCandidateIsApproachedAlongTheLine) {
  const HomotopyParameters candidate = Overlapped(sequence_, 0.9);
  const double limit = 0.37 * candidate.overlaps[0];
  const FakeFeasibility test = UpTo(limit);
  FeasiblePath path = Path(test, planned_);
  const double lambda = path.Toward(candidate, 10);
  EXPECT_LE(lambda, 0.37);
  EXPECT_GT(lambda, 0.37 - 1.0 / 1024 - 1e-9);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(path.incumbent().overlaps[i], lambda * candidate.overlaps[i], 1e-12);
  }
  EXPECT_LE(path.incumbent().overlaps[0], limit);
  EXPECT_TRUE(path.refusal());
  EXPECT_GT(path.refused(), 0);
  EXPECT_EQ(path.cost(), DurationOf(path.incumbent()));
}

TEST_F(FeasiblePathTest, TheIncumbentIsFeasibleAndNeverWorseWhateverIsProposed) {
  WalkDraw draw(330);
  const auto rule = [](const HomotopyParameters& p) {
    // Neither convex nor monotone.
    const double a = p.overlaps[0] + p.overlaps[1], b = p.durations[1] * p.height_scales[0];
    return std::sin(20 * a) + b > 0.3 ? Verdict::kFeasible : Verdict::kUndecided;
  };
  const FakeFeasibility test(evaluator_, rule);
  ASSERT_EQ(rule(planned_), Verdict::kFeasible);
  FeasiblePath path = Path(test, planned_);
  double cost = path.cost();
  for (int i = 0; i < 200; ++i) {
    path.Toward(draw.Parameters(sequence_, 0.0, 1.0), 4);
    EXPECT_LE(path.cost(), cost);
    cost = path.cost();
    EXPECT_EQ(rule(path.incumbent()), Verdict::kFeasible);
    EXPECT_NO_THROW(CheckParameters(sequence_, path.incumbent()));
  }
  EXPECT_GT(path.accepted(), 3);
  EXPECT_GE(path.refused(), 3);
}

TEST_F(FeasiblePathTest, ACandidateOfInfiniteOrUndefinedCostIsLeftAlone) {
  const FakeFeasibility test = UpTo(100);
  for (double cost :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    FeasiblePath path(
        sequence_,
        {.cost = [cost](const HomotopyParameters&) { return cost; },
         .prove =
             [&test](const SuperposedWalk& walk, double, const HomotopyParameters& incumbent,
                     MarginEvaluator::Scratch* scratch) {
               return CheckChanges(test, walk, incumbent, scratch);
             }},
        planned_, 1.0, evaluator_.MakeScratch());
    EXPECT_EQ(path.Toward(Overlapped(sequence_, 0.5), 3), 0.0);
    EXPECT_EQ(path.incumbent(), planned_);
  }
  EXPECT_TRUE(test.questions.empty());
}

TEST_F(FeasiblePathTest, OnlyWhatChangesIsProved) {
  const FakeFeasibility test = UpTo(100);
  FeasiblePath path = Path(test, planned_);
  HomotopyParameters candidate = planned_;
  candidate.overlaps[2] = 0.1;
  EXPECT_EQ(path.Toward(candidate, 3), 1.0);
  ASSERT_EQ(test.questions.size(), 1u);
  const SuperposedWalk walk(sequence_, candidate);
  EXPECT_EQ(test.questions[0].window.begin, walk.start_of(2));
  EXPECT_EQ(test.questions[0].window.end, walk.end_of(3));
}

}  // namespace
}  // namespace halfstep
