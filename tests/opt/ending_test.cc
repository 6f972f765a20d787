#include "opt/solvers/ending.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace halfstep::opt {
namespace {

TEST(Ending, HasANameOfItsOwnThatLeadsBack) {
  std::set<std::string_view> names;
  for (const Ending ending : kEndings) {
    EXPECT_TRUE(names.insert(Name(ending)).second) << Name(ending);
    EXPECT_EQ(EndingOf(Name(ending)), ending);
    EXPECT_TRUE(Meaning(ending).ends_with('.')) << Name(ending);
  }
  EXPECT_EQ(names.size(), 8u);
  EXPECT_EQ(EndingOf("finished"), std::nullopt);
  EXPECT_EQ(EndingOf(""), std::nullopt);
  EXPECT_EQ(EndingNames(),
            "converged, limit, deadline, interrupted, no_improvement, not_run, invalid_input, "
            "failed");
}

TEST(Ending, OnlyTheFirstFourHaveAResultOfTheirOwn) {
  for (const Ending ending : kEndings) {
    const std::set<std::string_view> own = {"converged", "limit", "deadline", "interrupted"};
    const std::set<std::string_view> broken = {"not_run", "invalid_input", "failed"};
    EXPECT_EQ(HasOwnResult(ending), own.contains(Name(ending))) << Name(ending);
    EXPECT_EQ(DidNotWork(ending), broken.contains(Name(ending))) << Name(ending);
  }
}

}  // namespace
}  // namespace halfstep::opt
