// How long ZMPs go from foot to foot: values by the parameters, what they say of double supports,
// slopes against differences, and proofs that leave out no half-step.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "smoothing/margins/slack_evaluator.h"
#include "tests/smoothing/drawn_motion.h"
#include "tests/smoothing/short_walks.h"

namespace halfstep {
namespace {

constexpr MarginFamily kSupport = MarginFamily::kDoubleSupport;

double ShiftOf(const HomotopyParameters& p, int i) {
  return p.zmp_shifts[static_cast<size_t>(i)] * p.durations[static_cast<size_t>(i)];
}

// The shortest shift that goes on at t; ∞: none does.
double ShiftAt(const SuperposedWalk& walk, double t) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < walk.num_half_steps(); ++i) {
    const double T = walk.parameters().durations[static_cast<size_t>(i)];
    const double from_middle = std::abs(t - walk.start_of(i) - 0.5 * T);
    const double shift = ShiftOf(walk.parameters(), i);
    if (from_middle <= 0.5 * shift) least = std::min(least, shift);
  }
  return least;
}

TEST(DoubleSupportMargin, IsTheShortestShiftThatGoesOn) {
  const MarginEvaluator evaluator(Hrp2(), {}, Only(kSupport, 0.0));
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  WalkDraw draw(1001);
  int watched = 0;
  for (int i = 0; i < Draws(40); ++i) {
    const SuperposedWalk walk = DrawnWalkOf(Hrp2(), &draw);
    for (int k = 0; k < 40; ++k) {
      const double t = draw.Uniform(0, walk.duration());
      if (NearKnot(walk, t, 1e-9)) continue;
      const double truth = ShiftAt(walk, t);
      const Margin margin = Of(evaluator.At(walk, walk.Locate(t), &scratch), kSupport);
      if (std::isinf(truth)) {
        EXPECT_EQ(margin.value, kUnlimited);
        EXPECT_EQ(evaluator.Subject(margin), "no half-step");
        continue;
      }
      ++watched;
      EXPECT_NEAR(margin.value, truth, 2e-12);
      EXPECT_NEAR(ShiftOf(walk.parameters(), margin.subject), truth, 1e-15);
      EXPECT_EQ(evaluator.Subject(margin), "half-step " + std::to_string(margin.subject + 1));
    }
  }
  EXPECT_GT(watched, Draws(40));
}

// Two shifts at once, either of them the shorter, at an instant by any of its names.
TEST(DoubleSupportMargin, IsTheSameByEveryNameOfAnInstant) {
  const MarginEvaluator evaluator(Hrp2(), {}, Only(kSupport, 0.0));
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  const HalfStepSequence sequence = TwoSteps(Hrp2());
  for (const int shorter : {1, 2}) {
    HomotopyParameters parameters = PlannedMotion(sequence);
    parameters.zmp_shifts.assign(4, 0.2);
    parameters.zmp_shifts[static_cast<size_t>(shorter)] = 0.1;
    parameters.overlaps[1] = NaturalOverlapBound(parameters, 1);
    const SuperposedWalk walk(sequence, parameters);
    const double middle = walk.start_of(2) + 0.5 * parameters.durations[2];
    for (int name = 0; name <= 2; ++name) {
      const Margin margin =
          Of(evaluator.At(walk, {name, middle - walk.start_of(name)}, &scratch), kSupport);
      EXPECT_EQ(margin.subject, shorter) << name;
      EXPECT_NEAR(margin.value, ShiftOf(parameters, shorter), 2e-12);
    }
  }
}

// From the landing of a step's foot to the next lift-off, half of both shifts at least.
TEST(DoubleSupportMargin, BoundsHowLongBothFeetStand) {
  WalkDraw draw(1002);
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < Draws(200); ++i) {
    const HalfStepSequence sequence = DrawSequence(Hrp2(), 3, {}, &draw);
    const HomotopyParameters parameters = draw.ExtremeParameters(sequence);
    const SuperposedWalk walk(sequence, parameters);
    for (int b = 1; b + 1 < walk.num_half_steps(); b += 2) {
      const double landing = walk.start_of(b) + walk.tracks(b).t1();
      const double lift_off = walk.start_of(b + 1) + walk.tracks(b + 1).t2();
      const double half = 0.5 * (ShiftOf(parameters, b) + ShiftOf(parameters, b + 1));
      EXPECT_GE(lift_off - landing, half - 1e-12);
      EXPECT_GE(lift_off - landing,
                std::min(ShiftOf(parameters, b), ShiftOf(parameters, b + 1)) - 1e-12);
      nearest = std::min(nearest, lift_off - landing - half);
      const Side foot = walk.half_step(b).swing();
      const double middle = 0.5 * (landing + lift_off);
      EXPECT_FALSE(walk.InAir(walk.Locate(middle), foot));
      EXPECT_FALSE(walk.InAir(walk.Locate(middle), Opposite(foot)));
    }
  }
  EXPECT_LT(nearest, kFewDraws ? 5e-2 : 5e-3) << "the bound is met nearly";
  // Of equal half-steps at their natural bounds it is met.
  const HalfStepSequence sequence = TwoSteps(Hrp2());
  const HomotopyParameters closest = Overlapped(sequence, 1.0);
  const SuperposedWalk walk(sequence, closest);
  const double both =
      walk.start_of(2) + walk.tracks(2).t2() - walk.start_of(1) - walk.tracks(1).t1();
  EXPECT_NEAR(both, ShiftOf(closest, 1), 1e-12);
}

TEST(DoubleSupportMargin, RowsHaveTheSlopesOfDifferences) {
  constexpr double kStep = 1e-6;
  const MarginEvaluator evaluator(Hrp2(), {}, Only(kSupport, 0.1));
  SlackEvaluator slacks(evaluator, 100.0);
  WalkDraw draw(1003);
  int rows = 0, along = 0, caught = 0;
  for (int i = 0; i < Draws(60); ++i) {
    const HalfStepSequence sequence = DrawSequence(Hrp2(), 2, {}, &draw);
    const HomotopyParameters parameters = draw.Parameters(sequence, 0.05, 0.8);
    const SuperposedWalk walk(sequence, parameters);
    // The middle of a shift, named by its own half-step.
    const int k = static_cast<int>(draw.Uniform(0, 3.99));
    const LocalTime at{k, 0.5 * parameters.durations[static_cast<size_t>(k)]};
    const auto slack = [&](const HomotopyParameters& p) {
      InstantSlacks there;
      slacks.At(SuperposedWalk(sequence, p), at, {}, false, &there);
      const auto row = std::ranges::find(there.rows, kSupport, &SlackRow::family);
      return row == there.rows.end() ? std::nan("") : row->slack;
    };
    InstantSlacks here;
    slacks.At(walk, at, {}, true, &here);
    const auto row = std::ranges::find(here.rows, kSupport, &SlackRow::family);
    ASSERT_NE(row, here.rows.end());
    if (std::ranges::count(here.rows, kSupport, &SlackRow::family) > 1) continue;  // two shifts
    ++rows;
    EXPECT_NEAR(row->slack, (ShiftOf(parameters, k) - 0.1) / Scale(kSupport), 1e-9);
    for (size_t p = 0; p < here.parameters.size(); ++p) {
      HomotopyParameters more = parameters, less = parameters;
      here.parameters[p].in(more) += kStep;
      here.parameters[p].in(less) -= kStep;
      const double difference = (slack(more) - slack(less)) / (2 * kStep);
      if (std::isnan(difference)) continue;
      const double analytic = here.gradient(row - here.rows.begin(), static_cast<Eigen::Index>(p));
      EXPECT_NEAR(analytic, difference, 1e-6 * (1 + std::abs(difference))) << p;
      along += difference != 0.0;
      // The control: T and the shift in each other's place.
      if (here.parameters[p] != HomotopyParameter{ParameterFamily::kDuration, k}) continue;
      const double broken = parameters.durations[static_cast<size_t>(k)] / Scale(kSupport);
      caught += std::abs(broken - difference) > 1e-6 * (1 + std::abs(difference));
    }
  }
  EXPECT_GT(rows, Draws(60) / 2);
  EXPECT_EQ(along, 2 * rows);
  EXPECT_EQ(caught, rows);
}

// Whichever half-step is short, and whatever overlaps it, the proof finds it.
TEST(DoubleSupportMargin, NoHalfStepIsLeftOut) {
  WalkDraw draw(1004);
  for (int i = 0; i < Draws(8); ++i) {
    const HalfStepSequence sequence = DrawSequence(Hrp2(), 2, {.stride = 0.3}, &draw);
    HomotopyParameters parameters = PlannedMotion(sequence);
    for (int k = 0; k < 4; ++k) {
      parameters.zmp_shifts.assign(4, 0.2);
      parameters.zmp_shifts[static_cast<size_t>(k)] = 0.1;
      for (int j = 0; j < 3; ++j) {
        parameters.overlaps[static_cast<size_t>(j)] =
            draw.Uniform(0, 1) < 0.7 ? NaturalOverlapBound(parameters, j) : 0.0;
      }
      const SuperposedWalk walk(sequence, parameters);
      const double shift = ShiftOf(parameters, k);
      Certificate certificate;
      const Feasibility kept = Certify(Hrp2(), {}, Only(kSupport, shift), walk, &certificate);
      const double others = std::ranges::min(parameters.durations) * 0.2;
      if (others <= shift) continue;
      EXPECT_EQ(kept.verdict, Verdict::kFeasible);
      const Feasibility missed =
          Certify(Hrp2(), {}, Only(kSupport, shift + 1e-9), walk, &certificate);
      ASSERT_EQ(missed.verdict, Verdict::kViolated);
      EXPECT_EQ(missed.witness.family, kSupport);
      EXPECT_EQ(missed.witness.subject, k);
    }
  }
}

// A planned shift of the demanded length is enough, whatever the numbers are.
TEST(DoubleSupportMargin, TheDemandedLengthIsEnough) {
  const HalfStepSequence sequence = TwoSteps(Hrp2());
  for (int hundredths = 60; hundredths < 200; hundredths += 7) {
    for (const double demanded : {0.05, 0.07, 0.1}) {
      HomotopyParameters parameters = PlannedMotion(sequence);
      const double T = hundredths / 100.0;
      parameters.durations.assign(4, T);
      parameters.zmp_shifts.assign(4, demanded / T);
      const MarginEvaluator evaluator(Hrp2(), {}, Only(kSupport, demanded));
      MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
      const LocalTime middle{1, 0.5 * T};
      const SuperposedWalk walk(sequence, parameters);
      EXPECT_EQ(evaluator.FirstViolation(walk, middle, &scratch), std::nullopt) << T;
    }
  }
}

TEST(DoubleSupportMargin, IsThereOnlyWhereItIsDemanded) {
  const MarginEvaluator none(Hrp2(), {}, {});
  EXPECT_THAT(none.families(), testing::Not(testing::Contains(kSupport)));
  const MarginEvaluator asked = none.WithLimits(Only(kSupport, 0.1));
  EXPECT_THAT(asked.families(), testing::Contains(kSupport));
  EXPECT_THAT(none.families(), testing::Not(testing::Contains(kSupport)));
  MarginEvaluator::Scratch scratch = none.MakeScratch();
  const HalfStepSequence sequence = TwoSteps(Hrp2());
  const SuperposedWalk walk(sequence, PlannedMotion(sequence));
  EXPECT_EQ(Of(none.At(walk, {0, 0.6}, &scratch), kSupport).value, kUnlimited);
  EXPECT_NEAR(Of(asked.At(walk, {0, 0.6}, &scratch), kSupport).value, 0.06, 1e-11);
}

}  // namespace
}  // namespace halfstep
