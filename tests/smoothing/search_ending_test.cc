#include "smoothing/methods/search_ending.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stop_token>
#include <string>

#include "smoothing/methods/smoothing_monitor.h"

namespace halfstep {
namespace {

using opt::Ending;
using testing::HasSubstr;
using testing::StartsWith;

SearchEnding After(Ending last, bool own) {
  SearchEnding end{.solver = "solver", .own = own, .kept = "the walk is a dichotomy's"};
  opt::Solution solution;
  solution.ending = last;
  solution.message = "Because.";
  end.Note(solution);
  return end;
}

// What a monitor ends a search by: the effort, the clock and the caller.
SmoothingMonitor Used() { return SmoothingMonitor({.effort = 0.0}); }
SmoothingMonitor Late() { return SmoothingMonitor({.deadline = 0.0}); }
SmoothingMonitor Stopped() {
  std::stop_source source;
  source.request_stop();
  return SmoothingMonitor({.stop = source.get_token()});
}

TEST(SearchEnding, WithoutAResultOfItsOwnIsNeverOneOfTheFirstFour) {
  for (const Ending last : opt::kEndings) {
    for (const auto& monitor : {Used, Late, Stopped, +[] { return SmoothingMonitor(); }}) {
      SearchEnding end = After(last, false);
      const SmoothingMonitor ended = monitor();
      if (ended.stopped()) end.NoteCut(ended);
      EXPECT_FALSE(HasOwnResult(end.Ending())) << end.Sentence();
      EXPECT_THAT(end.Sentence(), HasSubstr("the walk is a dichotomy's"));
      end.own = true;
      EXPECT_TRUE(HasOwnResult(end.Ending())) << end.Sentence();
      // What was left of the effort for the last round is nobody's concern.
      const std::string because = ended.stopped() ? "" : ": Because.";
      EXPECT_THAT(end.Sentence(), testing::EndsWith("the last solve of solver ended with " +
                                                    std::string(Name(last)) + because));
    }
  }
}

TEST(SearchEnding, SaysWhy) {
  SearchEnding never{.solver = "solver", .kept = "the walk is a dichotomy's"};
  EXPECT_EQ(never.Ending(), Ending::kNotRun);
  never.NoteCut(Used());
  EXPECT_EQ(never.Ending(), Ending::kNotRun);
  EXPECT_EQ(never.Sentence(),
            "the effort of 0 was used before solver was called; the walk is a dichotomy's");
  EXPECT_EQ(After(Ending::kInvalidInput, false).Ending(), Ending::kInvalidInput);
  EXPECT_EQ(After(Ending::kFailed, false).Ending(), Ending::kFailed);
  EXPECT_EQ(After(Ending::kConverged, false).Ending(), Ending::kNoImprovement);
  EXPECT_EQ(After(Ending::kLimit, true).Ending(), Ending::kConverged) << "rounds stopped to gain";
  EXPECT_EQ(After(Ending::kFailed, true).Ending(), Ending::kLimit) << "broke down, with a gain";
  SearchEnding end = After(Ending::kFailed, false);
  opt::Solution good;
  good.ending = Ending::kConverged;
  end.Note(good);
  EXPECT_EQ(end.Ending(), Ending::kNoImprovement) << "not every solve failed";
  end = After(Ending::kLimit, true);
  end.exhausted = true;
  EXPECT_EQ(end.Ending(), Ending::kLimit);
  end.NoteCut(Stopped());
  EXPECT_EQ(end.Ending(), Ending::kInterrupted);
  EXPECT_THAT(end.Sentence(), StartsWith("stopped from outside"));
}

// Only what the clock ends is told as such: that is not the same twice.
TEST(SearchEnding, TellsTheEffortFromTheClock) {
  SearchEnding end = After(Ending::kLimit, true);
  end.NoteCut(Used());
  EXPECT_EQ(end.Ending(), Ending::kLimit);
  EXPECT_THAT(end.Sentence(), StartsWith("the effort of 0 was used"));
  end.NoteCut(Late());
  EXPECT_EQ(end.Ending(), Ending::kDeadline);
  EXPECT_THAT(end.Sentence(), StartsWith("ended by the clock: the deadline of 0 s passed"));
}

// Rounds that gain nothing because rows stay violated are no convergence.
TEST(SearchEnding, TellsThatPointsStayedViolated) {
  SearchEnding end{.solver = "solver", .own = true};
  opt::Solution solution;
  solution.ending = Ending::kLimit;
  solution.message = "Because.";
  solution.max_violation = 0.43;
  solution.worst_row = "foot_speed in half-step 21";
  end.Note(solution);
  EXPECT_EQ(end.Ending(), Ending::kLimit);
  EXPECT_THAT(end.Sentence(), HasSubstr("stayed violated, foot_speed in half-step 21 by at least "
                                        "0.43"));
  solution.max_violation = 0.001;
  end.Note(solution);
  EXPECT_EQ(end.Ending(), Ending::kConverged) << "violated by next to nothing";
  solution.max_violation = 0.43;
  solution.feasible = true;
  end.Note(solution);
  EXPECT_EQ(end.Ending(), Ending::kConverged);
}

}  // namespace
}  // namespace halfstep
