#include "smoothing/methods/smoothing_monitor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stop_token>
#include <string>
#include <vector>

#include "smoothing/methods/methods.h"
#include "tests/smoothing/fake_feasibility.h"
#include "tests/smoothing/smoothed.h"
#include "tests/smoothing/test_walks.h"

namespace halfstep {
namespace {

using opt::Ending;
using testing::HasSubstr;

class SmoothingMonitorTest : public testing::Test {
 protected:
  FakeFeasibility Always(Verdict verdict) const {
    return {evaluator_, [verdict](const HomotopyParameters&) { return verdict; }};
  }
  // The planned motion with a shorter last half-step.
  HomotopyParameters Shorter() const {
    HomotopyParameters parameters = PlannedMotion(sequence_);
    parameters.durations.back() *= 0.9;
    return parameters;
  }

  const MarginEvaluator evaluator_{Hrp2(), {}, {}};
  const HalfStepSequence sequence_ = WalkDraw(80).Sequence(3);
};

TEST_F(SmoothingMonitorTest, AStartThatIsNotProvedIsRefusedWithItsWitness) {
  for (const Verdict verdict : {Verdict::kViolated, Verdict::kUndecided}) {
    const FakeFeasibility test = Always(verdict);
    const WalkProblem problem = ProblemOf(sequence_, test);
    SmoothingMonitor monitor;
    EXPECT_FALSE(monitor.BeginFeasibly(problem, PlannedMotion(sequence_)));
    const SmoothingResult planned = monitor.Refusal();
    EXPECT_EQ(planned.ending, Ending::kNotRun);
    EXPECT_FALSE(planned.feasible);
    EXPECT_THAT(planned.message, HasSubstr("the planned motion is not feasible: zmp"));
    EXPECT_EQ(planned.work, (Work{.instants = 1}));

    SmoothingMonitor other;
    EXPECT_FALSE(other.BeginFeasibly(problem, Shorter()));
    EXPECT_THAT(other.Refusal().message, HasSubstr("the start is not feasible"));
  }
}

TEST_F(SmoothingMonitorTest, AnEndingIsMeasuredAgainstTheStartOnlyWhenAsked) {
  const FakeFeasibility test = Always(Verdict::kFeasible);
  const WalkProblem problem = ProblemOf(sequence_, test);
  const HomotopyParameters start = PlannedMotion(sequence_);
  const auto finish = [&](const HomotopyParameters& found, Ending ending, bool against_start) {
    SmoothingMonitor monitor;
    EXPECT_TRUE(monitor.BeginFeasibly(problem, start));
    monitor.Adopt(*monitor.Accept(found), DurationOf(found), DurationOf(found));
    return against_start ? monitor.FinishAgainstStart(ending, "done", "; no gain")
                         : monitor.Finish(ending, "done");
  };
  EXPECT_EQ(finish(start, Ending::kConverged, true).ending, Ending::kNoImprovement);
  EXPECT_EQ(finish(start, Ending::kConverged, true).message, "done; no gain");
  EXPECT_EQ(finish(start, Ending::kNotRun, true).ending, Ending::kNotRun);
  EXPECT_EQ(finish(start, Ending::kConverged, false).ending, Ending::kConverged);
  const SmoothingResult gained = finish(Shorter(), Ending::kConverged, true);
  EXPECT_EQ(gained.ending, Ending::kConverged);
  EXPECT_EQ(gained.message, "done");
  EXPECT_EQ(gained.parameters, Shorter());
  EXPECT_TRUE(gained.time_to_first_improvement);
  EXPECT_FALSE(finish(start, Ending::kConverged, true).time_to_first_improvement);
}

TEST_F(SmoothingMonitorTest, ADroppedStartMakesEveryWalkAnImprovement) {
  const FakeFeasibility test = Always(Verdict::kFeasible);
  const WalkProblem problem = ProblemOf(sequence_, test);
  SmoothingMonitor monitor;
  monitor.Begin(problem, PlannedMotion(sequence_));
  monitor.DropStart();
  EXPECT_EQ(monitor.FinishAgainstStart(Ending::kConverged, "done", "; no gain").message, "done");
}

TEST_F(SmoothingMonitorTest, EndsForTheCallerByItsEffortOrByTheClockAndSaysWhich) {
  std::stop_source source;
  SmoothingMonitor endless({.stop = source.get_token()});
  EXPECT_FALSE(endless.stopped());
  source.request_stop();
  EXPECT_TRUE(endless.stopped());
  EXPECT_TRUE(endless.cut_off());
  EXPECT_EQ(endless.StopEnding(), Ending::kInterrupted);
  EXPECT_EQ(endless.StopReason(), "stopped from outside");

  const SmoothingMonitor used({.effort = 0.0});
  EXPECT_TRUE(used.stopped());
  EXPECT_FALSE(used.cut_off()) << "what the effort ends is the same twice";
  EXPECT_EQ(used.StopEnding(), Ending::kLimit);
  EXPECT_EQ(used.StopReason(), "the effort of 0 was used");

  const SmoothingMonitor late({.effort = 0.0, .deadline = 0.0});
  EXPECT_TRUE(late.stopped());
  EXPECT_TRUE(late.cut_off());
  EXPECT_FALSE(late.interrupted());
  EXPECT_EQ(late.StopEnding(), Ending::kDeadline);
  EXPECT_EQ(late.StopReason(), "ended by the clock: the deadline of 0 s passed");
}

// Of its own proofs, of what it is told and of parts, each once.
TEST_F(SmoothingMonitorTest, EffortIsUsedByAllWork) {
  const FakeFeasibility test = Always(Verdict::kFeasible);
  const WalkProblem problem = ProblemOf(sequence_, test);
  SmoothingMonitor monitor({.effort = 1.0});
  ASSERT_TRUE(monitor.BeginFeasibly(problem, PlannedMotion(sequence_)));
  EXPECT_EQ(monitor.work(), (Work{.instants = 1}));
  monitor.Count({.derivatives = 2, .linear_algebra = 30}, 4);
  const Work so_far{.instants = 1, .derivatives = 2, .linear_algebra = 30};
  EXPECT_EQ(monitor.work(), so_far);
  EXPECT_DOUBLE_EQ(monitor.EffortLeft(), 1.0 - so_far.effort());
  SmoothingMonitor part(monitor.Part(0.0, 1.0));
  EXPECT_DOUBLE_EQ(part.effort(), monitor.EffortLeft());
  ASSERT_TRUE(part.BeginFeasibly(problem, PlannedMotion(sequence_)));
  monitor.Count(part.Finish(Ending::kConverged, "done"));
  EXPECT_EQ(monitor.work(), (Work{.instants = 2, .derivatives = 2, .linear_algebra = 30}));
  EXPECT_FALSE(monitor.stopped());
  monitor.LimitTo(2.0);
  EXPECT_EQ(monitor.effort(), 1.0) << "limits only lower it";
  monitor.LimitTo(monitor.work().effort());
  EXPECT_TRUE(monitor.stopped());
  const SmoothingResult result = monitor.Finish(monitor.StopEnding(), monitor.StopReason());
  EXPECT_EQ(result.ending, Ending::kLimit);
  EXPECT_EQ(result.work, (Work{.instants = 2, .derivatives = 2, .linear_algebra = 30}));
  EXPECT_EQ(result.collision_queries, 4);
}

TEST_F(SmoothingMonitorTest, APartReportsItsShareAndStopsWithTheWhole) {
  std::vector<double> told;
  std::stop_source source;
  const SmoothingMonitor whole({.progress = [&](double done) { told.push_back(done); },
                                .stop = source.get_token(),
                                .deadline = 1000.0});
  const SmoothingMonitor part(whole.Part(0.2, 0.6));
  part.Progress(0.0);
  part.Progress(0.5);
  part.Progress(1.0);
  EXPECT_THAT(told, testing::Pointwise(testing::DoubleNear(1e-12), {0.2, 0.4, 0.6}));
  EXPECT_LE(part.deadline(), 1000.0);
  EXPECT_EQ(part.effort(), std::numeric_limits<double>::infinity());
  EXPECT_FALSE(part.stopped());
  source.request_stop();
  EXPECT_TRUE(part.interrupted());
  EXPECT_TRUE(SmoothingMonitor(SmoothingMonitor({.effort = 0.0}).Part(0, 1)).stopped());
  EXPECT_TRUE(SmoothingMonitor(SmoothingMonitor({.deadline = 0.0}).Part(0, 1)).cut_off());
}

// Every method: no work at all is a result, the feasible start, and its sentence says why. The
// bound of reference/lipm is a formula, which takes none.
TEST_F(SmoothingMonitorTest, EveryMethodKeepsTheStartWhenNothingIsLeft) {
  const FakeFeasibility test = Always(Verdict::kFeasible);
  const WalkProblem problem = ProblemOf(sequence_, test);
  const Methods methods = Methods::Standard();
  for (const bool by_clock : {false, true}) {
    for (const auto& smoother : methods.all()) {
      const std::string name = smoother->name();
      SCOPED_TRACE(name);
      MonitorOptions none;
      (by_clock ? none.deadline : none.effort) = 0.0;
      SmoothingMonitor monitor(none);
      const SmoothingResult result = smoother->Smooth(problem, {}, monitor);
      EXPECT_THAT(result.ending,
                  testing::AnyOf(Ending::kNotRun, Ending::kNoImprovement,
                                 by_clock ? Ending::kDeadline : Ending::kLimit,
                                 name == "given" ? Ending::kConverged : Ending::kNotRun));
      EXPECT_THAT(result.message, HasSubstr(name == "reference/lipm" ? "no walk of a LIPM"
                                            : name == "given"        ? "the walk that was given"
                                            : by_clock ? "ended by the clock: the deadline of 0 s"
                                                       : "the effort of 0 was used"));
      EXPECT_TRUE(result.feasible);
      EXPECT_LE(DurationOf(result.parameters), DurationOf(PlannedMotion(sequence_)));
      EXPECT_LE(test.questions.size(), 40u);
      test.questions.clear();
    }
  }
}

}  // namespace
}  // namespace halfstep
