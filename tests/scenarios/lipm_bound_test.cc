// A lower bound on all walks: never above a certified one, and what it is made of.

#include "smoothing/methods/lipm_bound.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "experiments/tables/result_tables.h"
#include "smoothing/methods/dichotomy.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/scenarios/load_experiment.h"
#include "tests/smoothing/smoothed.h"
#include "wpg/motion/lipm.h"

namespace halfstep {
namespace {

WalkProblem ProblemOf(const Experiment& e, const MarginLimits& limits) {
  return {e.robot, e.scene, e.sequence, limits};
}

TEST(LipmBound, IsNeverAboveACertifiedWalk) {
  // The shortest certified walks that are known, in s, whatever the half-steps' form (README.md).
  const std::pair<const char*, double> known[] = {{"fig3_two_half_steps", 1.821},
                                                  {"fig4_raw_sequence", 6.3},
                                                  {"fig5_box", 2.562},
                                                  {"bar_5cm", 4.96},
                                                  {"bar_8cm", 3.7},
                                                  {"bar_10cm", 5.197}};
  for (const auto& [name, shortest] : known) {
    const Experiment e = LoadExperiment(name);
    const WalkProblem problem = ProblemOf(e, e.config.smoothing.limits);
    const LipmBound bound = LowerBound(problem);
    const SmoothingResult walk = Smoothed(Dichotomy, problem, {.tolerance = 0.05});
    EXPECT_LE(bound.total(), std::min(shortest, DurationOf(walk.parameters))) << name;
    EXPECT_GE(bound.total(), 0.1 * shortest) << name << ": says nothing";
    EXPECT_GE(std::min({bound.feet, bound.first, bound.last}), 0.0);
  }
}

TEST(LipmBound, AMethodThatFindsNoWalkSaysIt) {
  const Experiment e = LoadExperiment("fig3_two_half_steps");
  const WalkProblem problem = ProblemOf(e, e.config.smoothing.limits);
  SmoothingMonitor monitor;
  const SmoothingResult result = TellLipmBound(problem, monitor);
  EXPECT_EQ(result.ending, opt::Ending::kNoImprovement);
  EXPECT_EQ(result.parameters, PlannedMotion(e.sequence));
  EXPECT_THAT(result.message, testing::HasSubstr("no walk of a LIPM on these footsteps"));
  MarginLimits strict = e.config.smoothing.limits;
  strict.demanded_of(MarginFamily::kZmp) = 0.4;  // more than a sole has
  SmoothingMonitor other;
  EXPECT_EQ(TellLipmBound(ProblemOf(e, strict), other).ending, opt::Ending::kNotRun);
}

// The header and the last cell of each row of summary.csv.
std::vector<std::string> LastColumn(const std::string& table) {
  std::vector<std::string> cells;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);)
    cells.push_back(line.substr(line.rfind(',') + 1));
  return cells;
}

TEST(LipmBound, SummariesTellTheGapOfOtherMethodsWhereItIsKnown) {
  const Experiment e = LoadExperiment("fig3_two_half_steps");
  const WalkProblem problem = ProblemOf(e, e.config.smoothing.limits);
  std::vector<MethodRun> runs;
  for (const char* name : {"raw", "dichotomy", "reference/lipm"}) runs.emplace_back(name);
  runs[0].result.parameters = PlannedMotion(e.sequence);
  runs[1].result = Smoothed(Dichotomy, problem, {.tolerance = 0.05});
  SmoothingMonitor monitor;
  runs[2].result = TellLipmBound(problem, monitor);
  for (MethodRun& run : runs) SampleTrajectory(problem.evaluator(), e.sequence, 0.1, &run);
  const std::vector<std::string> gaps = LastColumn(SummaryCsv(problem.evaluator(), runs).text);
  ASSERT_EQ(gaps.size(), 4u);
  EXPECT_EQ(gaps[0], "gap_lipm");
  const double bound = LowerBound(problem).total();
  EXPECT_NEAR(std::stod(gaps[1]), 4.0 / bound - 1.0, 1e-9);
  EXPECT_NEAR(std::stod(gaps[2]), DurationOf(runs[1].result.parameters) / bound - 1.0, 1e-9);
  EXPECT_EQ(gaps[3], "");
  runs.pop_back();
  EXPECT_EQ(LastColumn(SummaryCsv(problem.evaluator(), runs).text).front(), "gap_to_reference");
}

TEST(LipmBound, FollowsTheLimitsAndNotTheFrame) {
  const Experiment e = LoadExperiment("bar_8cm");
  MarginLimits limits = e.config.smoothing.limits;
  limits.foot_speed = 1.0;
  limits.foot_yaw_rate = std::nullopt;
  const LipmBound fast = LowerBound(ProblemOf(e, limits));
  limits.foot_speed = 0.5;
  const LipmBound slow = LowerBound(ProblemOf(e, limits));
  EXPECT_NEAR(slow.feet, 2.0 * fast.feet, 1e-12);
  EXPECT_GE(slow.first, fast.first);
  Experiment moved = e;
  moved.sequence = Moved({3.0, -1.0, 0.0}, Mirrored(e.sequence));
  const LipmBound there = LowerBound(ProblemOf(moved, limits));
  EXPECT_NEAR(there.feet, slow.feet, 1e-9);
  EXPECT_NEAR(there.first, slow.first, 1e-9);
  EXPECT_NEAR(there.last, slow.last, 1e-9);
  limits.foot_speed = std::nullopt;
  EXPECT_EQ(LowerBound(ProblemOf(e, limits)).feet, 0.0);
}

// A foot at 0.1 m/s is in the air for so long that the CoM has to be over the other one first.
// Along y, the ZMP at its best at every time: with a little less time for the shift the CoM falls
// over, with a little more it does not.
TEST(LipmBound, TheFirstShiftIsWhatTheBestZmpNeeds) {
  const Experiment e = LoadExperiment("bar_8cm");
  MarginLimits limits = e.config.smoothing.limits;
  limits.foot_speed = 0.1;
  limits.demanded_of(MarginFamily::kFootSpeed) = 0.0;
  const LipmBound bound = LowerBound(ProblemOf(e, limits));
  ASSERT_GT(bound.first, 0.02);
  const double omega = dynamic_cast<const Lipm&>(*e.sequence.model).omega(),
               half = 0.5 * e.robot.sole_size.y();
  const double outer = -0.085 - half;  // of the right sole, whose foot goes first
  const double inner = 0.085 - half + limits.demanded_of(MarginFamily::kZmp);
  const double flight =
      (0.274 + 2.0 * limits.demanded_of(MarginFamily::kFloor)) / *limits.foot_speed;
  // ω ∫ e^{−ωs} p(s) ds with the least p: what the CoM may be set off from.
  const auto least = [&](double shift) {
    double sum = 0.0;
    constexpr double kStep = 1e-4;
    for (double s = 0.5 * kStep; s < 20.0; s += kStep) {
      const bool one = s > shift && s < shift + flight;
      sum += omega * std::exp(-omega * s) * (one ? inner : outer) * kStep;
    }
    return sum;
  };
  EXPECT_GT(least(0.98 * bound.first), 0.0) << "the CoM is at y = 0";
  EXPECT_LT(least(1.02 * bound.first), 0.0);
}

}  // namespace
}  // namespace halfstep
