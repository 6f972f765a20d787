#include "experiments/live/executor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/smoothing/test_walks.h"

namespace halfstep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

WalkPlan SomeWalk(WalkDraw* draw) {
  const HalfStepSequence sequence = draw->Sequence(4);
  return {sequence, Overlapped(sequence, 0.5)};
}

TEST(Executor, BeginsWhatIsGrantedAndNothingElse) {
  WalkDraw draw(701);
  const WalkPlan plan = SomeWalk(&draw);
  Executor executor(plan, {.through = 2});
  const SuperposedWalk& walk = executor.walk();
  EXPECT_THAT(executor.Advance(walk.start_of(1)), IsEmpty());
  EXPECT_THAT(executor.Advance(walk.start_of(2) + 1e-6), ElementsAre(1, 2));
  EXPECT_FALSE(executor.stopped());
  EXPECT_THAT(executor.Advance(walk.start_of(3) + 1e-6), IsEmpty());
  EXPECT_TRUE(executor.stopped());
  EXPECT_EQ(executor.rests_from(), walk.end_of(2));
  EXPECT_EQ(executor.executed().num_half_steps(), 3);
}

TEST(Executor, BeginsNothingThatEndsAfterTheProofs) {
  WalkDraw draw(702);
  const WalkPlan plan = SomeWalk(&draw);
  const double end = plan.Walk().end_of(1);
  Executor in_time(plan, {.through = 7, .valid_until = end});
  EXPECT_THAT(in_time.Advance(plan.Walk().start_of(1) + 1e-6), ElementsAre(1));
  Executor too_late(plan, {.through = 7, .valid_until = end - 1e-9});
  EXPECT_THAT(too_late.Advance(plan.Walk().start_of(1) + 1e-6), IsEmpty());
  EXPECT_TRUE(too_late.stopped());
}

TEST(Executor, NothingBeginsAfterARevocation) {
  WalkDraw draw(703);
  const WalkPlan plan = SomeWalk(&draw);
  Executor executor(plan, {.through = 7});
  executor.Advance(plan.Walk().start_of(1) + 1e-6);
  executor.Revoke();
  EXPECT_THAT(executor.Advance(1e3), IsEmpty());
  EXPECT_TRUE(executor.stopped());
}

TEST(Executor, TakesOnlySuccessors) {
  WalkDraw draw(704);
  const WalkPlan plan = SomeWalk(&draw);
  Executor executor(plan, {.through = 7});
  const double now = executor.walk().start_of(3) + 1e-6;
  executor.Advance(now);
  ASSERT_EQ(executor.begun(), 3);
  // It changes what has begun.
  WalkPlan other = plan;
  other.parameters.durations[2] *= 1.1;
  EXPECT_THAT(executor.TakeOver(other, {}, now), HasSubstr("has begun"));
  // It would have had to begin already.
  EXPECT_THAT(executor.TakeOver(plan, {}, executor.walk().start_of(4) + 1e-6),
              HasSubstr("should have begun"));
  EXPECT_EQ(executor.TakeOver(Delayed(plan, 3, now + 2.0), {.through = 7}, now), "");
  EXPECT_NEAR(executor.walk().start_of(4), now + 2.0, 1e-12);
}

TEST(Executor, GoesOnAfterAStop) {
  WalkDraw draw(705);
  const WalkPlan plan = SomeWalk(&draw);
  Executor executor(plan, {.through = 1});
  executor.Advance(100.0);
  ASSERT_TRUE(executor.stopped());
  EXPECT_NE(executor.TakeOver(plan, {.through = 7}, 100.0), "");
  ASSERT_EQ(executor.TakeOver(Delayed(plan, 1, 101.0), {.through = 7}, 100.0), "");
  EXPECT_FALSE(executor.stopped());
  EXPECT_THAT(executor.Advance(101.5), testing::Contains(2));
}

}  // namespace
}  // namespace halfstep
