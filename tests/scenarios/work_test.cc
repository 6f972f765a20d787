// Work in place of time: what ends a search, and that what is found is the same twice.

#include "smoothing/margins/work.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>
#include <utility>

#include "smoothing/methods/methods.h"
#include "smoothing/methods/solver_method_options.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/scenarios/load_experiment.h"
#include "tests/scenarios/same_results.h"
#include "tests/smoothing/smoothed.h"

namespace halfstep {
namespace {

using testing::StartsWith;

TEST(Work, IsAddedByKind) {
  const Work a{.instants = 3, .derivatives = 5, .intervals = 7, .linear_algebra = 11000};
  const Work b{.instants = 1, .derivatives = 20, .intervals = 300, .linear_algebra = 4000000};
  Work both = a;
  both += b;
  EXPECT_EQ(both, (Work{4, 25, 307, 4011000}));
  EXPECT_EQ(both - a, b);
  EXPECT_NE(a, b);
  EXPECT_EQ(a.evaluated(), 15);
  EXPECT_NEAR(both.effort(), a.effort() + b.effort(), 1e-12);
  EXPECT_EQ(Work().effort(), 0.0);
  for (const Work& more : {Work{.instants = 1}, Work{.derivatives = 1}, Work{.intervals = 1},
                           Work{.linear_algebra = 1}}) {
    EXPECT_GT(more.effort(), 0.0);
  }
  EXPECT_GT(Work{.derivatives = 1}.effort(), Work{.instants = 1}.effort());
}

class WorkTest : public testing::Test {
 protected:
  static MethodOptions With(double effort) {
    MethodOptions options;
    OptimizerOptions& optimizer = options.Edit(OptimizerGroup()).options;
    optimizer.program.parameters = {.heights = true, .durations = true};
    optimizer.effort = effort;
    return options;
  }
  SmoothingResult Find(const std::string& method, const MethodOptions& options,
                       MonitorOptions monitor_options = {}) const {
    SmoothingMonitor monitor(std::move(monitor_options));
    return Methods::Standard().Find(method).Smooth(ProblemOf(e_.sequence, test_), options, monitor);
  }

  const Experiment e_ = LoadExperiment("fig3_two_half_steps");
  const CertifiedFeasibility test_{{e_.robot, e_.scene, e_.config.smoothing.limits}, {}};
};

TEST_F(WorkTest, TheSameEffortFindsTheSameTwice) {
  for (const char* method :
       {"halfstep/sqp", "halfstep/barrier", "halfstep/horizon", "dichotomy/uniform"}) {
    for (const double effort : {0.02, 0.2}) {
      SCOPED_TRACE(std::string(method) + ", effort " + std::to_string(effort));
      const SmoothingResult one = Find(method, With(effort));
      EXPECT_GT(one.work.effort(), 0.0);
      // A proof that is under way is finished, and multipliers are asked for in the end.
      EXPECT_LT(one.work.effort(), effort + 0.2);
      ExpectSame(one, Find(method, With(effort)));
    }
  }
}

TEST_F(WorkTest, EffortEndsASearchAsALimit) {
  const SmoothingResult result = Find("halfstep/sqp", With(0.15));
  EXPECT_EQ(result.ending, opt::Ending::kLimit) << result.message;
  EXPECT_THAT(result.message, StartsWith("the effort of 0.15 was used"));
  EXPECT_LT(DurationOf(result.parameters), DurationOf(PlannedMotion(e_.sequence)));
  // The caller's is a limit just as well.
  const SmoothingResult callers = Find("halfstep/sqp", With(100.0), {.effort = 0.15});
  ExpectSame(result, callers);
}

TEST_F(WorkTest, EverySearchTellsWhatItUsed) {
  const SmoothingResult result = Find("halfstep/sqp", With(0.3));
  EXPECT_GT(result.work.instants, 0);
  EXPECT_GT(result.work.derivatives, 0);
  EXPECT_GT(result.work.intervals, 0);
  EXPECT_GT(result.work.linear_algebra, 0);
  ASSERT_FALSE(result.iterates.empty());
  double effort = 0.0;
  long instants = 0;
  for (const SmoothingIterate& iterate : result.iterates) {
    EXPECT_GE(iterate.effort, effort);
    EXPECT_GE(iterate.instants, instants);
    effort = iterate.effort;
    instants = iterate.instants;
  }
  EXPECT_LE(effort, result.work.effort());
  EXPECT_LE(instants, result.work.evaluated());
}

// The clock is an emergency stop: it is told, and what was found before it stays. The first walk
// that is found waits until the clock has passed the deadline.
TEST_F(WorkTest, TheClockEndsASearchAsADeadline) {
  const SmoothingResult before = Find("halfstep/sqp", With(0.3));
  ASSERT_TRUE(before.time_to_first_improvement);
  MethodOptions options = With(1e6);
  OptimizerOptions& optimizer = options.Edit(OptimizerGroup()).options;
  optimizer.deadline = 1.0 + 5.0 * *before.time_to_first_improvement;
  const auto end =
      std::chrono::steady_clock::now() + std::chrono::duration<double>(optimizer.deadline + 1.0);
  const double planned = DurationOf(PlannedMotion(e_.sequence));
  const auto wait = [&](const HomotopyParameters& walk) {
    if (DurationOf(walk) < planned - 0.1) std::this_thread::sleep_until(end);
  };
  const SmoothingResult result = Find("halfstep/sqp", options, {.on_incumbent = wait});
  EXPECT_EQ(result.ending, opt::Ending::kDeadline) << result.message;
  EXPECT_THAT(result.message, StartsWith("ended by the clock: the deadline of "));
  EXPECT_TRUE(result.feasible);
  EXPECT_LT(DurationOf(result.parameters), planned - 0.1);
}

}  // namespace
}  // namespace halfstep
