#include "smoothing/changed_windows.h"

#include <gtest/gtest.h>

#include "tests/smoothing/test_walks.h"

namespace halfstep {
namespace {

// Some parameters changed, the rest as they were; overlaps stay in their bounds.
HomotopyParameters Changed(const HalfStepSequence& sequence, HomotopyParameters parameters,
                           WalkDraw* draw) {
  for (const HomotopyParameter& p : AllParameters(sequence)) {
    if (draw->Uniform(0, 1) > 0.12) continue;
    p.in(parameters) *= draw->Uniform(0.8, 1.2);
  }
  for (int i = 0; i < sequence.num_junctions(); ++i) {
    double& overlap = parameters.overlaps[static_cast<size_t>(i)];
    overlap = std::min(overlap, NaturalOverlapBound(sequence, parameters.durations, i));
  }
  return parameters;
}

TEST(ChangedWindows, OutsideOfThemTheWalkIsTheSameOneEarlierOrLater) {
  WalkDraw draw(320);
  int outside = 0, with_windows = 0;
  for (int i = 0; i < Draws(60); ++i) {
    const HalfStepSequence sequence = draw.Sequence(6);
    const HomotopyParameters from = draw.Parameters(sequence, 0.0, 1.0);
    const SuperposedWalk before(sequence, from);
    const SuperposedWalk after(sequence, Changed(sequence, from, &draw));
    const std::vector<TimeWindow> windows = ChangedWindows(from, after);
    double last = -1.0;
    for (const TimeWindow& window : windows) {
      EXPECT_GT(window.begin, last);
      EXPECT_GE(window.end, window.begin);
      EXPECT_GE(window.begin, 0.0);
      EXPECT_LE(window.end, after.duration() + 1e-12);
      last = window.end;
    }
    with_windows += !windows.empty();
    for (int s = 0; s < 100; ++s) {
      const double t = draw.Uniform(0, after.duration());
      bool inside = false;
      for (const TimeWindow& w : windows) inside = inside || (t >= w.begin && t <= w.end);
      if (inside) continue;
      ++outside;
      const LocalTime at = after.Locate(t);
      EXPECT_LT((Stacked(after.At(at)) - Stacked(before.At(at))).cwiseAbs().maxCoeff(), 1e-8);
      EXPECT_EQ(after.StepInAir(at), before.StepInAir(at));
    }
  }
  EXPECT_GT(outside, Draws(60) * 10);
  EXPECT_GT(with_windows, Draws(60) / 2);
}

TEST(ChangedWindows, NothingChangedNoWindowAndEachFamilyItsStretch) {
  WalkDraw draw(321);
  const HalfStepSequence sequence = draw.Sequence(3);
  const HomotopyParameters from = draw.Parameters(sequence, 0.2, 0.8);
  EXPECT_TRUE(ChangedWindows(from, SuperposedWalk(sequence, from)).empty());
  for (const HomotopyParameter& p : AllParameters(sequence)) {
    HomotopyParameters to = from;
    p.in(to) *= 0.99;
    if (p.family == HomotopyParameter::Family::kDuration) to.overlaps = from.overlaps;
    const SuperposedWalk walk(sequence, to);
    const std::vector<TimeWindow> windows = ChangedWindows(from, walk);
    ASSERT_FALSE(windows.empty());
    EXPECT_LT(windows.back().end - windows.front().begin, 0.9 * walk.duration());
  }
}

}  // namespace
}  // namespace halfstep
