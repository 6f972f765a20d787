#include "smoothing/methods/search_ending.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace halfstep {
namespace {

using opt::Ending;
using testing::HasSubstr;

SearchEnding After(Ending last, bool own) {
  SearchEnding end{.solver = "solver", .own = own, .kept = "the walk is a dichotomy's"};
  opt::Solution solution;
  solution.ending = last;
  solution.message = "Because.";
  end.Note(solution);
  return end;
}

TEST(SearchEnding, WithoutAResultOfItsOwnIsNeverOneOfTheFirstFour) {
  for (const Ending last : opt::kEndings) {
    for (const bool stopped : {false, true}) {
      for (const bool late : {false, true}) {
        SearchEnding end = After(last, false);
        end.stopped = stopped;
        end.deadline_passed = late;
        EXPECT_FALSE(HasOwnResult(end.Ending())) << end.Sentence();
        EXPECT_THAT(end.Sentence(), HasSubstr("the walk is a dichotomy's"));
        end.own = true;
        EXPECT_TRUE(HasOwnResult(end.Ending())) << end.Sentence();
        const std::string because = last == Ending::kDeadline ? "" : ": Because.";
        EXPECT_THAT(end.Sentence(),
                    HasSubstr("solver last ended " + std::string(Name(last)) + because));
      }
    }
  }
}

TEST(SearchEnding, SaysWhy) {
  SearchEnding never{.solver = "solver", .kept = "the walk is a dichotomy's"};
  EXPECT_EQ(never.Ending(), Ending::kNotRun);
  never.deadline_passed = true;
  EXPECT_EQ(never.Sentence(),
            "the deadline passed before solver was called; the walk is a dichotomy's");
  EXPECT_EQ(After(Ending::kInvalidInput, false).Ending(), Ending::kInvalidInput);
  EXPECT_EQ(After(Ending::kFailed, false).Ending(), Ending::kFailed);
  EXPECT_EQ(After(Ending::kConverged, false).Ending(), Ending::kNoImprovement);
  EXPECT_EQ(After(Ending::kDeadline, true).Ending(), Ending::kDeadline);
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
  end.stopped = true;
  EXPECT_EQ(end.Ending(), Ending::kInterrupted);
}

// What was given, not what was left of it for the last round.
TEST(SearchEnding, TellsTheDeadlineThatWasGiven) {
  SearchEnding end = After(Ending::kDeadline, true);
  end.deadline = 3.0;
  end.last_message = "The deadline of 0.132 s passed.";
  EXPECT_EQ(end.Sentence(), "the deadline of 3 s passed; solver last ended deadline");
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
