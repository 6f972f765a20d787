#include "smoothing/methods/incumbent.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "smoothing/program/overlap_program.h"
#include "tests/smoothing/fake_feasibility.h"
#include "tests/smoothing/test_walks.h"

namespace halfstep {
namespace {

// As a whole: the rules below are no matter of stretches.
std::function<std::vector<Margin>(const SuperposedWalk&, double, MarginEvaluator::Scratch*)> Prove(
    const FakeFeasibility& test) {
  return [&test](const SuperposedWalk& walk, double, MarginEvaluator::Scratch* scratch) {
    const Feasibility answer = test.Check(walk, {0.0, walk.duration()}, scratch);
    return answer.verdict == Verdict::kFeasible ? std::vector<Margin>{}
                                                : std::vector<Margin>{answer.witness};
  };
}

class IncumbentTest : public testing::Test {
 protected:
  Incumbent Path(const FakeFeasibility& test, const HomotopyParameters& start) const {
    return {
        sequence_,
        {.cost = [](const HomotopyParameters& p) { return DurationOf(p); }, .prove = Prove(test)},
        start,
        DurationOf(start),
        &scratch_};
  }
  // Feasible while the first overlap is at most `limit` [s].
  FakeFeasibility UpTo(double limit) const {
    return {evaluator_, [limit](const HomotopyParameters& p) {
              return p.overlaps[0] <= limit ? Verdict::kFeasible : Verdict::kViolated;
            }};
  }

  const MarginEvaluator evaluator_{Hrp2(), {}, {}};
  mutable MarginEvaluator::Scratch scratch_ = evaluator_.MakeScratch();
  const HalfStepSequence sequence_ = WalkDraw(80).Sequence(2);
  const HomotopyParameters planned_ = PlannedMotion(sequence_);
};

TEST_F(IncumbentTest, AProvedCandidateBecomesTheIncumbentAtOnce) {
  const FakeFeasibility test = UpTo(100);
  Incumbent path = Path(test, planned_);
  const HomotopyParameters candidate = Overlapped(sequence_, 0.5);
  EXPECT_EQ(path.Toward(candidate, 5), 1.0);
  EXPECT_EQ(path.parameters(), candidate);
  EXPECT_EQ(path.cost(), DurationOf(candidate));
  EXPECT_EQ(path.accepted(), 1);
  EXPECT_TRUE(path.refusals().empty());
  // What costs more, or as much, is not even asked about.
  const size_t asked = test.questions.size();
  EXPECT_EQ(path.Toward(planned_, 5), 0.0);
  EXPECT_EQ(path.Toward(candidate, 5), 0.0);
  EXPECT_EQ(test.questions.size(), asked);
  EXPECT_EQ(path.parameters(), candidate);
}

TEST_F(IncumbentTest, StepsAroundARefusalStayAndTheRestIsTriedAgain) {
  const HalfStepSequence sequence = WalkDraw(80).Sequence(4);  // 7 junctions
  const HomotopyParameters planned = PlannedMotion(sequence);
  const HomotopyParameters candidate = Overlapped(sequence, 0.9);
  // Refused at half-step 0 while the first overlap is above 0.37 of the candidate's.
  const FakeFeasibility test = UpTo(0.37 * candidate.overlaps[0]);
  Incumbent path(
      sequence,
      {.cost = [](const HomotopyParameters& p) { return DurationOf(p); }, .prove = Prove(test)},
      planned, DurationOf(planned), &scratch_);
  EXPECT_EQ(path.Toward(candidate, 1), 0.0);
  EXPECT_EQ(path.refused(), 1);
  EXPECT_EQ(path.parameters(), planned);
  // They go half of the way first, then a quarter, which is short enough.
  const double lambda = path.Toward(candidate, 3);
  EXPECT_NEAR(lambda, 6.5 / 8, 1e-12);
  EXPECT_EQ(path.refusals().size(), 1u);
  for (size_t i = 0; i < 7; ++i) {
    EXPECT_NEAR(path.parameters().overlaps[i], (i < 2 ? 0.25 : 1.0) * candidate.overlaps[i], 1e-12)
        << i;
  }
  EXPECT_EQ(path.cost(), DurationOf(path.parameters()));
}

// Half-steps of a step share numbers, so none of them moves without the other.
TEST_F(IncumbentTest, StepsThatAreHeldStayFromTheFirstPointOn) {
  const HalfStepSequence sequence = WalkDraw(80).Sequence(4);
  const HomotopyParameters planned = PlannedMotion(sequence);
  HomotopyParameters candidate = Overlapped(sequence, 0.5);
  for (double& T : candidate.durations) T *= 0.9;
  for (double& eta : candidate.height_scales) eta *= 0.8;
  const FakeFeasibility test = UpTo(100);
  Incumbent path(
      sequence,
      {.cost = [](const HomotopyParameters& p) { return DurationOf(p); }, .prove = Prove(test)},
      planned, DurationOf(planned), &scratch_);
  std::vector<bool> held(8, false);
  held[3] = true;  // of the second step
  const HomotopyParameters beside = path.Beside(candidate, held);
  EXPECT_EQ(path.parameters(), planned) << "nothing is proved, so nothing moves";
  EXPECT_EQ(test.questions.size(), 0u);
  EXPECT_NEAR(path.Toward(candidate, 5, held), 6.0 / 8, 1e-12);
  EXPECT_EQ(test.questions.size(), 1u);
  EXPECT_TRUE(path.refusals().empty());
  EXPECT_EQ(path.parameters(), beside);
  for (size_t k = 0; k < 8; ++k) {
    const bool stays = k == 2 || k == 3;
    EXPECT_NEAR(beside.durations[k], (stays ? planned : candidate).durations[k], 1e-12) << k;
    EXPECT_NEAR(beside.height_scales[k / 2], (stays ? planned : candidate).height_scales[k / 2],
                1e-12);
  }
  for (size_t i = 0; i < 7; ++i) {
    const bool stays = i >= 1 && i <= 3;  // beside half-step 2 or 3
    EXPECT_NEAR(beside.overlaps[i], stays ? 0.0 : candidate.overlaps[i], 1e-12) << i;
  }
  // Where all are held there is nothing to ask about.
  EXPECT_EQ(path.Toward(candidate, 5, std::vector<bool>(8, true)), 0.0);
  EXPECT_EQ(test.questions.size(), 1u);
}

// The half-steps of the refusal last longer until they are proved, and all else moves at once.
TEST_F(IncumbentTest, HalfStepsThatAreRefusedLastLongerAndTheRestMoves) {
  const HalfStepSequence sequence = WalkDraw(80).Sequence(4);
  const HomotopyParameters planned = PlannedMotion(sequence);
  HomotopyParameters candidate = Overlapped(sequence, 0.5);
  for (double& T : candidate.durations) T *= 0.6;
  const double least = 1.05 * candidate.durations[0];
  const FakeFeasibility test(evaluator_, [least](const HomotopyParameters& p) {
    return p.durations[0] >= least ? Verdict::kFeasible : Verdict::kViolated;
  });
  for (const double longest : {planned.durations[0], candidate.durations[0]}) {
    Incumbent path(sequence,
                   {.cost = [](const HomotopyParameters& p) { return DurationOf(p); },
                    .prove = Prove(test),
                    .longest = std::vector<double>(8, longest)},
                   planned, DurationOf(planned), &scratch_);
    EXPECT_GT(path.Toward(candidate, 8), 0.0);
    EXPECT_EQ(path.refusals().size(), 1u) << "of the candidate itself";
    for (size_t k = 2; k < 8; ++k) {
      EXPECT_EQ(path.parameters().durations[k], candidate.durations[k]) << k;
    }
    EXPECT_GE(path.parameters().durations[0], least);
    // Where it may not last longer, its step goes half of the way.
    const bool longer = longest > candidate.durations[0];
    const double half = 0.5 * (planned.durations[0] + candidate.durations[0]);
    EXPECT_NEAR(path.parameters().durations[0], longer ? 1.08 * candidate.durations[0] : half,
                1e-9);
  }
}

// Regression: a + (b − a) may be a little less than b, where b ends a range.
TEST_F(IncumbentTest, WhatMovesIsTheCandidateToTheLastBit) {
  HomotopyParameters candidate = Overlapped(sequence_, 0.5);
  for (double& ramp : candidate.of(ParameterFamily::kZmpBumpRamp)) ramp = 0.1;
  const FakeFeasibility test = UpTo(100);
  Incumbent path = Path(test, planned_);
  EXPECT_EQ(path.Toward(candidate, 1), 1.0);
  EXPECT_EQ(path.parameters(), candidate);
  EXPECT_EQ(path.Beside(planned_, {}), planned_);
}

TEST_F(IncumbentTest, WhereWhatIsRefusedDoesNotMoveItIsLeftAlone) {
  const HomotopyParameters candidate = Overlapped(sequence_, 0.9);
  const FakeFeasibility test(evaluator_, [&](const HomotopyParameters& p) {
    for (size_t i = 0; i < p.overlaps.size(); ++i) {
      if (p.overlaps[i] > 0.3 * candidate.overlaps[i]) return Verdict::kViolated;
    }
    return Verdict::kFeasible;
  });
  Incumbent path = Path(test, planned_);
  EXPECT_EQ(path.Toward(candidate, 8), 0.0);
  EXPECT_EQ(path.refused(), 4) << "all of it, half, a quarter, and none of what was refused";
  EXPECT_EQ(path.parameters(), planned_);
}

TEST_F(IncumbentTest, WithoutLocalityAllIsHeldBackAlike) {
  const HomotopyParameters candidate = Overlapped(sequence_, 0.9);
  const FakeFeasibility test = UpTo(0.3 * candidate.overlaps[0]);
  Incumbent path(sequence_,
                 {.cost = [](const HomotopyParameters& p) { return DurationOf(p); },
                  .prove = Prove(test),
                  .local = false},
                 planned_, DurationOf(planned_), &scratch_);
  EXPECT_EQ(path.Toward(candidate, 5), 0.25);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(path.parameters().overlaps[i], 0.25 * candidate.overlaps[i], 1e-12);
  }
}

TEST_F(IncumbentTest, TheIncumbentIsFeasibleAndNeverWorseWhateverIsProposed) {
  WalkDraw draw(330);
  const auto rule = [](const HomotopyParameters& p) {
    // Neither convex nor monotone.
    const double a = p.overlaps[0] + p.overlaps[1], b = p.durations[1] * p.height_scales[0];
    return std::sin(20 * a) + b > 0.3 ? Verdict::kFeasible : Verdict::kUndecided;
  };
  const FakeFeasibility test(evaluator_, rule);
  ASSERT_EQ(rule(planned_), Verdict::kFeasible);
  Incumbent path = Path(test, planned_);
  double cost = path.cost();
  for (int i = 0; i < 200; ++i) {
    path.Toward(draw.Parameters(sequence_, 0.0, 1.0), 4);
    EXPECT_LE(path.cost(), cost);
    cost = path.cost();
    EXPECT_EQ(rule(path.parameters()), Verdict::kFeasible);
    EXPECT_NO_THROW(CheckParameters(sequence_, path.parameters()));
  }
  EXPECT_GT(path.accepted(), 3);
  EXPECT_GT(path.refused(), 0);
}

TEST_F(IncumbentTest, ACandidateOfInfiniteOrUndefinedCostIsLeftAlone) {
  const FakeFeasibility test = UpTo(100);
  for (double cost :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    Incumbent path(
        sequence_,
        {.cost = [cost](const HomotopyParameters&) { return cost; }, .prove = Prove(test)},
        planned_, 1.0, &scratch_);
    EXPECT_EQ(path.Toward(Overlapped(sequence_, 0.5), 3), 0.0);
    EXPECT_EQ(path.parameters(), planned_);
  }
  EXPECT_TRUE(test.questions.empty());
}

}  // namespace
}  // namespace halfstep
