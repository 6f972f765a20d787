// What changes in a walk when one overlap does.

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "smoothing/walk/superposed_walk.h"
#include "tests/smoothing/test_walks.h"

namespace halfstep {
namespace {

TEST(WalkOverlap, SetOverlapGivesTheWalkOfTheChangedParameters) {
  WalkDraw draw(31);
  const HalfStepSequence sequence = draw.Sequence(4);
  SuperposedWalk walk(sequence, PlannedMotion(sequence));
  for (int i = 0; i < 100; ++i) {
    const int junction = static_cast<int>(draw.Uniform(0, 7));
    const double bound = NaturalOverlapBound(walk.parameters(), junction);
    walk.SetOverlap(junction, draw.Uniform(0, 1) * bound);
    const SuperposedWalk fresh(sequence, walk.parameters());
    for (int k = 0; k < walk.num_half_steps(); ++k) EXPECT_EQ(walk.start_of(k), fresh.start_of(k));
    const double t = draw.Uniform(0, fresh.duration());
    EXPECT_EQ(walk.At(t).value, fresh.At(t).value);
  }
  EXPECT_THROW(walk.SetOverlap(-1, 0.1), std::logic_error);
  EXPECT_THROW(walk.SetOverlap(7, 0.1), std::logic_error);
  EXPECT_THROW(walk.SetOverlap(0, -3601.0), std::logic_error);
  for (int junction = 0; junction < 7; ++junction) {
    const double bound = NaturalOverlapBound(walk.parameters(), junction);
    EXPECT_NO_THROW(walk.SetOverlap(junction, bound));
    EXPECT_THROW(walk.SetOverlap(junction, bound + 1e-6), std::logic_error);
  }
}

TEST(WalkOverlap, AnOverlapChangesNothingBeforeItsStretchAndOnlyTheTimeAfterIt) {
  WalkDraw draw(32);
  for (int i = 0; i < 100; ++i) {
    const HalfStepSequence sequence = draw.Sequence(4);
    const SuperposedWalk before(sequence, draw.ExtremeParameters(sequence));
    SuperposedWalk after = before;
    const int junction = static_cast<int>(draw.Uniform(0, 7));
    const double bound = NaturalOverlapBound(before.parameters(), junction);
    after.SetOverlap(junction, draw.Uniform(0, 1) * bound);
    const double begin = std::min(before.start_of(junction + 1), after.start_of(junction + 1));
    const double end = before.end_of(junction);  // of all half-steps up to the junction
    EXPECT_EQ(end, after.end_of(junction));
    const double shift = after.duration() - before.duration();
    for (int n = 0; n < 20; ++n) {
      double t = draw.Uniform(0, begin);
      EXPECT_LT(Largest(before.At(t).value - after.At(t).value), 1e-12);
      // After the later of the two ends, seen from either walk.
      t = draw.Uniform(end + std::max(0.0, -shift), before.duration());
      if (t >= before.duration()) continue;
      EXPECT_LT(Largest(before.At(t).value - after.At(t + shift).value), 1e-12);
      EXPECT_LT(Largest(before.At(t).first - after.At(t + shift).first), 1e-10);
    }
  }
}

}  // namespace
}  // namespace halfstep
