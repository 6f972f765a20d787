// How fast a foot sinks near the floor: values by differences of heights, slopes by differences,
// and that the limit is kept in the last centimetre by what is certified.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "smoothing/margins/slack_evaluator.h"
#include "tests/smoothing/drawn_motion.h"
#include "tests/smoothing/short_walks.h"

namespace halfstep {
namespace {

constexpr MarginFamily kFamily = MarginFamily::kLandingSpeed;
constexpr double kLimit = 0.3;  // [m/s]

MarginLimits Limited(double limit) {
  MarginLimits limits = Only(kFamily, 0.0);
  limits.demanded_of(MarginFamily::kDoubleSupport) = kNotDemanded;
  limits.landing_speed = limit;
  return limits;
}

double HeightOf(const SuperposedWalk& walk, double t, Side foot) {
  return walk.At(t).value[FootIndex(foot) + 2];
}

TEST(LandingSpeedMargin, IsByDifferencesOfHeights) {
  constexpr double kStep = 1e-5;
  const MarginEvaluator evaluator(Hrp2(), {}, Limited(kLimit));
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  WalkDraw draw(1011);
  int low = 0, high = 0, standing = 0;
  for (int i = 0; i < Draws(40); ++i) {
    const SuperposedWalk walk = DrawnWalkOf(Hrp2(), &draw);
    for (int k = 0; k < 60; ++k) {
      const double t = draw.Uniform(0, walk.duration());
      if (NearKnot(walk, t, 2 * kStep)) continue;
      const LocalTime at = walk.Locate(t);
      const double margin = Of(evaluator.At(walk, at, &scratch), kFamily).value;
      const int step = walk.StepInAir(at);
      if (step < 0) {
        EXPECT_EQ(margin, kUnlimited);
        ++standing;
        continue;
      }
      const Side foot = walk.half_step(2 * step).swing();
      const double z = HeightOf(walk, t, foot);
      const double sinks =
          (HeightOf(walk, t - kStep, foot) - HeightOf(walk, t + kStep, foot)) / (2 * kStep);
      EXPECT_NEAR(margin, (z < 0.01 ? kLimit : kLimit * z / 0.01) - sinks, 1e-6);
      ++(z < 0.01 ? low : high);
    }
  }
  EXPECT_GT(std::min({low, high, standing}), Draws(40));
}

TEST(LandingSpeedMargin, RowsHaveTheSlopesOfDifferences) {
  constexpr double kStep = 1e-6;
  const MarginEvaluator evaluator(Hrp2(), {}, Limited(kLimit));
  SlackEvaluator slacks(evaluator, 1e3);
  WalkDraw draw(1012);
  int compared = 0, caught = 0;
  for (int i = 0; i < Draws(120); ++i) {
    const HalfStepSequence sequence = DrawSequence(Hrp2(), 2, {}, &draw);
    const HomotopyParameters parameters = draw.Parameters(sequence, 0.05, 0.8);
    const SuperposedWalk walk(sequence, parameters);
    const double t = draw.Uniform(0, walk.duration());
    const LocalTime at = walk.Locate(t);
    const int step = walk.StepInAir(at);
    if (step < 0 || NearKnot(walk, t, 1e-3)) continue;
    const double z = HeightOf(walk, t, walk.half_step(2 * step).swing());
    if (std::abs(z - 0.01) < 1e-3) continue;  // the kink
    const auto slack = [&](const HomotopyParameters& p) {
      InstantSlacks there;
      slacks.At(SuperposedWalk(sequence, p), at, {}, false, &there);
      const auto row = std::ranges::find(there.rows, kFamily, &SlackRow::family);
      return row == there.rows.end() ? std::nan("") : row->slack;
    };
    InstantSlacks here;
    slacks.At(walk, at, {}, true, &here);
    const auto row = std::ranges::find(here.rows, kFamily, &SlackRow::family);
    ASSERT_NE(row, here.rows.end());
    for (size_t p = 0; p < here.parameters.size(); ++p) {
      HomotopyParameters more = parameters, less = parameters;
      here.parameters[p].in(more) += kStep;
      here.parameters[p].in(less) -= kStep;
      const double difference = (slack(more) - slack(less)) / (2 * kStep);
      if (std::isnan(difference)) continue;
      const double analytic = here.gradient(row - here.rows.begin(), static_cast<Eigen::Index>(p));
      const double near = 1e-4 * (1 + std::abs(difference));
      EXPECT_NEAR(analytic, difference, near) << p;
      ++compared;
      caught += std::abs(-analytic - difference) > near;  // the control: a wrong sign
    }
  }
  EXPECT_GT(compared, kFewDraws ? 0 : 120 * 5);  // few draws compare less of each
  EXPECT_GT(caught, compared / 10);
}

// The limit that is certified bounds the speed below 1 cm, and one that is a little lower is
// missed.
TEST(LandingSpeedMargin, BoundsTheSpeedInTheLastCentimetre) {
  WalkDraw draw(1013);
  for (int i = 0; i < Draws(6); ++i) {
    const HalfStepSequence sequence = DrawSequence(Hrp2(), 2, {.stride = 0.3}, &draw);
    const SuperposedWalk walk(sequence, Overlapped(sequence, 0.3));
    double fastest = 0.0, needed = 0.0;
    for (double t = 0.0; t < walk.duration(); t += 5e-4) {
      const int step = walk.StepInAir(walk.Locate(t));
      if (step < 0) continue;
      const int z = FootIndex(walk.half_step(2 * step).swing()) + 2;
      const WalkJet jet = walk.At(t);
      if (jet.value[z] <= 0.01) fastest = std::max(fastest, -jet.first[z]);
      needed = std::max(needed, -jet.first[z] / std::max(1.0, jet.value[z] / 0.01));
    }
    EXPECT_GT(fastest, 0.0);
    EXPECT_GE(needed, fastest);
    Certificate certificate;
    EXPECT_EQ(Certify(Hrp2(), {}, Limited(1.002 * needed), walk, &certificate).verdict,
              Verdict::kFeasible);
    const Feasibility missed = Certify(Hrp2(), {}, Limited(0.99 * needed), walk, &certificate);
    ASSERT_EQ(missed.verdict, Verdict::kViolated);
    EXPECT_EQ(missed.witness.family, kFamily);
  }
}

TEST(LandingSpeedMargin, IsThereOnlyWhereThereIsALimit) {
  EXPECT_THAT(MarginEvaluator(Hrp2(), {}, {}).families(), testing::Not(testing::Contains(kFamily)));
  EXPECT_THAT(MarginEvaluator(Hrp2(), {}, Limited(kLimit)).families(), testing::Contains(kFamily));
}

}  // namespace
}  // namespace halfstep
