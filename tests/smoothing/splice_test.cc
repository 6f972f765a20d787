// Rests, and walks that follow on others. Statements by number: smoothing/README.md, "Successors".

#include "smoothing/walk/splice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "tests/smoothing/test_walks.h"

namespace halfstep {
namespace {

std::vector<Footstep> SomeFootsteps(Side first, const std::array<Foothold, 2>& from, int count,
                                    WalkDraw* draw) {
  std::vector<Footstep> footsteps;
  std::array<Foothold, 2> feet = from;
  Side side = first;
  for (int i = 0; i < count; ++i) {
    const Foothold& support = feet[static_cast<size_t>(Index(Opposite(side)))];
    const Foothold landing =
        support *
        Foothold::Level({draw->Uniform(-0.1, 0.2), Sign(side) * draw->Uniform(0.2, 0.25), 0.0});
    footsteps.push_back({.side = side, .X_WF = landing, .via_height = 0.2, .duration = 1.5});
    feet[static_cast<size_t>(Index(side))] = landing;
    side = Opposite(side);
  }
  return footsteps;
}

void ExpectEqualUntil(const SuperposedWalk& a, const SuperposedWalk& b, double until,
                      WalkDraw* draw) {
  for (int i = 0; i < 20; ++i) {
    const double t = draw->Uniform(0, 1) * std::min(until, a.duration());
    const WalkJet x = a.At(t), y = b.At(t);
    ASSERT_EQ(x.value, y.value) << t;
    ASSERT_EQ(x.first, y.first) << t;
    ASSERT_EQ(x.second, y.second) << t;
    EXPECT_EQ(a.StepInAir(a.Locate(t)), b.StepInAir(b.Locate(t)));
  }
}

TEST(Rest, NothingMovesWhileTheRobotRests) {
  WalkDraw draw(601);
  for (int i = 0; i < Draws(50); ++i) {
    const HalfStepSequence sequence = draw.Sequence(3);
    HomotopyParameters parameters = draw.Parameters(sequence, 0.0, 0.3);
    const int junction = static_cast<int>(draw.Uniform(0, sequence.num_junctions()));
    // The neighbours do not reach into the rest, whatever their overlaps.
    parameters.overlaps[static_cast<size_t>(junction)] = -draw.Uniform(0.1, 5.0);
    const SuperposedWalk walk(sequence, parameters);
    const double begin = walk.end_of(junction), end = walk.start_of(junction + 1);
    EXPECT_NEAR(end - begin, -parameters.overlaps[static_cast<size_t>(junction)], 1e-12);
    const WalkJet at_rest = walk.At(begin);
    EXPECT_LT(Largest(at_rest.first), 1e-9);
    for (int k = 0; k < 5; ++k) {
      const WalkJet jet = walk.At(draw.Uniform(begin, end));
      EXPECT_LT(Largest(jet.value - at_rest.value), 1e-12);
      EXPECT_EQ(Largest(jet.first), 0.0);
      EXPECT_EQ(Largest(jet.second), 0.0);
    }
    // On one foot after an up half-step, on both after a down half-step.
    EXPECT_EQ(walk.StepInAir(walk.Locate(0.5 * (begin + end))),
              junction % 2 == 0 ? junction / 2 : -1);
    EXPECT_EQ(Largest(walk.SecondBounds(begin + 0.01, end - 0.01)), 0.0);
  }
}

TEST(Rest, IsNoLongerThanAnHour) {
  WalkDraw draw(602);
  const HalfStepSequence sequence = draw.Sequence(2);
  HomotopyParameters parameters = PlannedMotion(sequence);
  parameters.overlaps[1] = -kLongestRest;
  EXPECT_NO_THROW(SuperposedWalk(sequence, parameters));
  parameters.overlaps[1] = -kLongestRest - 1.0;
  EXPECT_THROW(SuperposedWalk(sequence, parameters), std::logic_error);
}

TEST(Rest, IsKeptByClampingWhereItWasWanted) {
  WalkDraw draw(603);
  const HalfStepSequence sequence = draw.Sequence(2);
  HomotopyParameters rests = PlannedMotion(sequence);
  rests.overlaps[1] = -2.0;
  HomotopyParameters point = rests;
  point.overlaps[0] = -0.1;
  point.overlaps[2] = 100.0;
  ClampOverlaps(rests, &point);
  EXPECT_EQ(point.overlaps[0], 0.0);
  EXPECT_EQ(point.overlaps[1], -2.0);
  EXPECT_EQ(point.overlaps[2], NaturalOverlapBound(point, 2));
}

// A plan, and the last of its half-steps that has begun.
std::pair<WalkPlan, int> DrawnPlan(WalkDraw* draw) {
  const HalfStepSequence sequence = draw->Sequence(4);
  const HomotopyParameters parameters = draw->ExtremeParameters(sequence);
  return {{sequence, parameters}, static_cast<int>(draw->Uniform(0, sequence.num_junctions()))};
}

// Statement 1.
TEST(Successor, DelayedAgreesToTheBitUntilTheNextHalfStep) {
  WalkDraw draw(610);
  for (int i = 0; i < Draws(50); ++i) {
    const auto [plan, last] = DrawnPlan(&draw);
    const SuperposedWalk walk = plan.Walk();
    const double begin = walk.start_of(last + 1) + draw.Uniform(0.01, 3.0);
    const SuperposedWalk delayed = Delayed(plan, last, begin).Walk();
    EXPECT_NEAR(delayed.start_of(last + 1), begin, 1e-12);
    EXPECT_EQ(CommonHalfSteps(walk, delayed), last + 1);
    EXPECT_EQ(AgreeUntil(walk, delayed), walk.start_of(last + 1));
    ExpectEqualUntil(walk, delayed, walk.start_of(last + 1), &draw);
    EXPECT_TRUE(IsC2At(delayed, walk.start_of(last + 1), 1e-8));
    EXPECT_TRUE(IsC2At(delayed, begin, 1e-8));
  }
}

// Statements 1 and 2.
TEST(Successor, ChangedAgreesToTheBitAndEndsOnTheNewFootsteps) {
  WalkDraw draw(611);
  for (int i = 0; i < Draws(50); ++i) {
    const auto [plan, last] = DrawnPlan(&draw);
    const SuperposedWalk walk = plan.Walk();
    const bool up = last % 2 == 0;
    const Side swing = walk.half_step(last).swing();
    const std::vector<Footstep> footsteps =
        SomeFootsteps(up ? swing : Opposite(swing), StanceAfter(plan.sequence, last), 3, &draw);
    const WalkPlan changed = Changed(plan, last, footsteps);
    const SuperposedWalk successor = changed.Walk();
    EXPECT_EQ(changed.sequence.size(), last + 1 + (up ? 5 : 6));
    EXPECT_GE(CommonHalfSteps(walk, successor), last + 1);
    const double until = std::min(walk.start_of(last + 1), successor.start_of(last + 1));
    EXPECT_GE(AgreeUntil(walk, successor), until);
    ExpectEqualUntil(walk, successor, until, &draw);
    EXPECT_TRUE(IsC2At(successor, until, 1e-8));
    // It begins where half-step `last` ends: value by value, and lands where it was told to.
    const WalkJet end = successor.At(successor.duration());
    for (size_t k = footsteps.size() - 2; k < footsteps.size(); ++k) {
      const Pose2 foot = FootPose(end.value, footsteps[k].side);
      EXPECT_NEAR(foot.x, footsteps[k].X_WF.x, 1e-9);
      EXPECT_NEAR(foot.y, footsteps[k].X_WF.y, 1e-9);
      EXPECT_NEAR(foot.yaw, footsteps[k].X_WF.yaw, 1e-9);
    }
    for (int k = 1; k < successor.num_half_steps(); ++k)
      EXPECT_TRUE(IsC2At(successor, successor.start_of(k), 1e-8));
  }
}

TEST(Successor, NoFootstepsEndTheWalkOnBothFeet) {
  WalkDraw draw(612);
  const HalfStepSequence sequence = draw.Sequence(3);
  const WalkPlan plan{sequence, draw.Parameters(sequence, 0.0, 0.9)};
  const SuperposedWalk ended = Changed(plan, 3, {}).Walk();
  EXPECT_EQ(ended.num_half_steps(), 4);
  EXPECT_EQ(ended.duration(), plan.Walk().end_of(3));
  EXPECT_THROW(Changed(plan, 2, {}), std::logic_error);
  const Side other = Opposite(plan.Walk().half_step(2).swing());
  EXPECT_THROW(Changed(plan, 2, SomeFootsteps(other, StanceAfter(sequence, 2), 1, &draw)),
               std::logic_error);
}

TEST(Successor, EqualWalksAgreeForEver) {
  WalkDraw draw(613);
  const HalfStepSequence sequence = draw.Sequence(3);
  const WalkPlan plan{sequence, draw.Parameters(sequence, 0.0, 0.9)};
  EXPECT_EQ(AgreeUntil(plan.Walk(), plan.Walk()), std::numeric_limits<double>::infinity());
  // A last half-step that differs in its η alone is not common, nor is its up half-step.
  WalkPlan higher = plan;
  higher.parameters.height_scales.back() *= 0.5;
  EXPECT_EQ(CommonHalfSteps(plan.Walk(), higher.Walk()), 4);
  // Nor one whose support point differs.
  WalkPlan aside = plan;
  aside.parameters.support_points[1] += 0.01;
  EXPECT_EQ(CommonHalfSteps(plan.Walk(), aside.Walk()), 2);
  // Nor one of another form.
  WalkPlan later = plan;
  later.parameters.of(ParameterFamily::kFootDelay)[3] += 0.01;
  EXPECT_EQ(CommonHalfSteps(plan.Walk(), later.Walk()), 3);
}

TEST(Successor, WhatHasBegunIsFixed) {
  WalkDraw draw(614);
  const HalfStepSequence sequence = draw.Sequence(4);
  const WalkPlan plan{sequence, draw.Parameters(sequence, 0.0, 0.9)};
  for (int last = 0; last < sequence.size(); ++last) {
    const ParameterTable table(sequence, FixedByBeginning(plan, last), EveryFamily());
    for (const ParameterRow& row : table.rows()) {
      const int i = row.parameter.index;
      const auto [first, second] = Traits(row.parameter.family).half_steps(i);
      const bool begun = row.parameter.family == ParameterFamily::kOverlap ? second <= last
                         : Traits(row.parameter.family).move != nullptr    ? first - 1 <= last
                                                                           : first <= last;
      const auto stays = Traits(row.parameter.family).stays;
      EXPECT_EQ(row.fixed, begun || (stays != nullptr && stays(sequence, i))) << last << " " << i;
      if (begun) {
        EXPECT_EQ(row.start, row.parameter.in(plan.parameters));
      }
    }
  }
}

}  // namespace
}  // namespace halfstep
