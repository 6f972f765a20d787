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
        EXPECT_THAT(end.Sentence(),
                    HasSubstr("solver last ended " + std::string(Name(last)) + ": Because."));
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

}  // namespace
}  // namespace halfstep
