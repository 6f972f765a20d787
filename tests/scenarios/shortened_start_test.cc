#include "smoothing/methods/shortened_start.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/scenarios/load_experiment.h"

namespace halfstep {
namespace {

ProgramOptions Few(const ParameterChoice& choice) {
  ProgramOptions options;
  options.parameters = choice;
  options.watch.instants = 8;
  return options;
}

class ShortenedStartTest : public testing::Test {
 protected:
  HomotopyParameters Shortened(const ParameterChoice& choice,
                               const std::vector<FixedParameter>& fixed = {}) const {
    const OverlapProgram program(e_.sequence, evaluator_, Few(choice), 0.0, fixed);
    return ShortenedStart(program, PlannedMotion(e_.sequence));
  }

  const Experiment e_ = LoadExperiment("bar_8cm");
  const MarginEvaluator evaluator_{e_.robot, e_.scene, e_.config.smoothing.limits};
  const HomotopyParameters planned_ = PlannedMotion(e_.sequence);
};

// Half-steps over the bar have to stay slower than those beside it.
TEST_F(ShortenedStartTest, DurationsAloneAreShortenedEachAsFarAsItsRowsAllow) {
  const HomotopyParameters shortened = Shortened({.heights = true, .durations = true});
  const auto [least, most] = std::ranges::minmax(shortened.durations);
  EXPECT_GE(least, 0.5 * 2.0 - 1e-12);  // the least duration of the box
  EXPECT_LE(most, 2.0 + 1e-12);
  EXPECT_LT(least, 0.85 * most);
  EXPECT_EQ(shortened.overlaps, planned_.overlaps);
  EXPECT_EQ(shortened.height_scales, planned_.height_scales);
}

TEST_F(ShortenedStartTest, ADurationThatIsFixedStays) {
  const ParameterChoice choice{.heights = true, .durations = true};
  const HomotopyParameters free = Shortened(choice);
  const size_t k =
      static_cast<size_t>(std::ranges::min_element(free.durations) - free.durations.begin());
  const HomotopyParameters fixed =
      Shortened(choice, {{{ParameterFamily::kDuration, static_cast<int>(k)}, 2.0}});
  EXPECT_LT(free.durations[k], 2.0);
  EXPECT_EQ(fixed.durations[k], 2.0);
}

TEST_F(ShortenedStartTest, WhereNoDurationIsFreeItIsTheWalkThatWasGiven) {
  EXPECT_EQ(Shortened({.heights = true}), planned_);
  ParameterChoice no_shorter{.durations = true};
  no_shorter.bound("least_duration") = 1.0;
  EXPECT_EQ(Shortened(no_shorter), planned_);
}

}  // namespace
}  // namespace halfstep
