// What of a walk is proved without looking at it again, and that it is what looking would find.

#include <gtest/gtest.h>

#include "experiments/live/isolated_half_steps.h"
#include "experiments/live/prepared_world.h"
#include "experiments/live/remembered_half_steps.h"
#include "experiments/live/replanner.h"
#include "smoothing/walk/splice.h"
#include "tests/draws.h"
#include "tests/live/small_episode.h"

namespace halfstep {
namespace {

class HalfStepProofsTest : public testing::Test {
 protected:
  HalfStepProofsTest() { world_.goal = small_.config.experiment.goal.Region(); }

  Proposal Begin(int junctions) const {
    std::mt19937_64 random(1);
    return replanner_.Begin(small_.start, *replanner_.Prepare(world_), junctions, random);
  }

  const SmallWorld& small_ = SmallWorld::Get();
  const Replanner replanner_{small_.place, small_.config, *small_.baked.cached.volumes};
  World world_;
};

TEST_F(HalfStepProofsTest, AreRememberedWhereverAndWheneverTheHalfStepIs) {
  const WalkPlan plan = Begin(3).plan;
  const SuperposedWalk walk = plan.Walk();
  RememberedHalfSteps remembered(/*by_place=*/false);
  for (int j = 0; j < walk.num_half_steps(); ++j) {
    remembered.Remember(walk, j);
    EXPECT_TRUE(remembered.Knows(walk, j));
  }
  const SuperposedWalk later = Delayed(plan, 5, walk.end_of(5) + 1.0).Walk();
  EXPECT_TRUE(remembered.Knows(later, 4));
  const int last = walk.num_half_steps() - 1;
  EXPECT_TRUE(remembered.Knows(later, last));
  int known = 0;
  for (int draw = 0; draw < 20; ++draw) {
    const double x = 0.37 * draw;
    const SuperposedWalk elsewhere(Moved({x, -x, 0.1 * x}, plan.sequence), plan.parameters);
    for (int j = 0; j <= last; ++j) known += remembered.Knows(elsewhere, j);
  }
  EXPECT_GT(known, 19 * (last + 1));  // few round apart
}

TEST_F(HalfStepProofsTest, AreNotRememberedOfAnotherOverlap) {
  WalkPlan plan = Begin(3).plan;
  RememberedHalfSteps remembered(/*by_place=*/false);
  remembered.Remember(plan.Walk(), 1);
  EXPECT_FALSE(remembered.Knows(plan.Walk(), 3));
  plan.parameters.overlaps[1] += 1e-9;  // what comes after is no part of it
  EXPECT_TRUE(remembered.Knows(plan.Walk(), 1));
  plan.parameters.overlaps[0] -= 1e-9;
  EXPECT_FALSE(remembered.Knows(plan.Walk(), 1));
}

// Nor of another form, whatever number of it differs.
TEST_F(HalfStepProofsTest, AreNotRememberedOfAnotherForm) {
  const WalkPlan plan = Begin(3).plan;
  RememberedHalfSteps remembered(/*by_place=*/false);
  remembered.Remember(plan.Walk(), 1);
  for (const ParameterFamily family : AllParameterFamilies()) {
    const ParameterFamilyTraits& traits = Traits(family);
    if (!traits.of_form || traits.move != nullptr) continue;
    WalkPlan other = plan;
    double& value = other.parameters.of(family)[static_cast<size_t>(traits.index_at(1))];
    value += value > traits.least ? -1e-6 : 1e-6;
    EXPECT_FALSE(remembered.Knows(other.Walk(), 1)) << traits.name;
  }
}

// Where a swept volume is free the certificate finds the same, and it is not asked about half-steps
// that overlap.
TEST_F(HalfStepProofsTest, OfVolumesAreThoseOfTheCertificate) {
  const WalkPlan plan = Begin(0).plan;
  const SuperposedWalk walk = plan.Walk();
  const StepSet& set = small_.baked.cached.volumes->set;
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> along(-0.3, 1.5), across(-0.5, 0.5);
  int free = 0, met = 0;
  for (int draw = 0; draw < Draws(40); ++draw) {
    world_.scene.obstacles = {Bar("bar", along(random), across(random))};
    const auto among = replanner_.Prepare(world_);
    for (int j = 1; j < walk.num_half_steps(); ++j) {
      const bool is_free = IsolatedAndFree(walk, j, set, *among->query);
      ++(is_free ? free : met);
      if (!is_free) continue;
      EXPECT_EQ(among->safety.AmongObstacles(walk, j, j, 0.0).through, j);
    }
  }
  EXPECT_GT(free, met);
  EXPECT_GT(met, 0);
  WalkPlan overlapping = plan;
  overlapping.parameters.overlaps[2] = 0.1;
  world_.scene.obstacles.clear();
  const auto empty = replanner_.Prepare(world_);
  EXPECT_TRUE(IsolatedAndFree(walk, 2, set, *empty->query));
  EXPECT_FALSE(IsolatedAndFree(overlapping.Walk(), 2, set, *empty->query));
  EXPECT_FALSE(IsolatedAndFree(overlapping.Walk(), 3, set, *empty->query));
}

// It was refused for what comes after the rest, and then nothing was ever planned again.
TEST_F(HalfStepProofsTest, ARobotThatRestsIsNotRefusedForWhatWouldComeNext) {
  const WalkPlan plan = Begin(0).plan;
  WalkPlan delayed = Delayed(plan, 3, plan.Walk().end_of(3) + 2.0);
  delayed.parameters.overlaps[4] = NaturalOverlapBound(delayed.parameters, 4);
  const SuperposedWalk walk = delayed.Walk();
  const Foothold ahead = walk.X_WS(5);
  world_.scene.obstacles = {Bar("bar", ahead.x + 0.2, ahead.y)};
  const auto among = replanner_.Prepare(world_);
  const double now = walk.end_of(3) + 1.0;
  const Safety safety = among->safety.AmongObstacles(walk, 3, walk.num_half_steps() - 1, now);
  EXPECT_GE(safety.through, 3);
  EXPECT_TRUE(safety.refused_by);
}

// What the set was proved of is not proved anew: the proof would find the same of half-steps that
// begin at rest, and none is spared of one that does not or that is of no element.
TEST_F(HalfStepProofsTest, OfTheSetAreThoseOfTheRobotAlone) {
  const Proposal first = Begin(0);
  const WalkPlan& plan = first.plan;
  const StepSet& set = small_.baked.cached.volumes->set;
  const SafetyCheck alone(small_.place.robot, Scene{}, small_.config.experiment);
  const SuperposedWalk walk = plan.Walk();
  EXPECT_FALSE(EndsWithSetElement(walk, 0, set));  // from where the robot stood
  for (int j = 1; j < walk.num_half_steps(); ++j) {
    EXPECT_TRUE(EndsWithSetElement(walk, j, set)) << j;
    EXPECT_EQ(alone.OfRobot(walk, j, j).through, j);
  }
  WalkPlan overlapping = plan;
  overlapping.parameters.overlaps[2] = 0.1;
  EXPECT_TRUE(EndsWithSetElement(overlapping.Walk(), 2, set));  // what comes after is no part of it
  EXPECT_FALSE(EndsWithSetElement(overlapping.Walk(), 3, set));
  EXPECT_TRUE(EndsWithSetElement(overlapping.Walk(), 4, set));
  WalkPlan shorter = plan;
  shorter.parameters.durations[3] -= 0.01;
  EXPECT_FALSE(EndsWithSetElement(shorter.Walk(), 3, set));
  // A first walk proves its first half-step alone: an interval each 70 ms, most of them once.
  constexpr double kIntervals = 200.0;
  EXPECT_GT(first.effort.all(), 0.0);
  EXPECT_LT(first.effort.all(), 1e-6 * Work::kInterval * kIntervals);
}

// Other footsteps behind a half-step leave the walk cut after it as it was, to the bit, so what was
// proved of that one stays.
TEST_F(HalfStepProofsTest, StayWhereOtherFootstepsFollow) {
  const Proposal begun = Begin(4);
  world_.version = 1;
  world_.goal.X_WG.y += 0.4;
  std::mt19937_64 random(1);
  const Proposal changed = replanner_.Propose({.plan = begun.plan,
                                               .smoothed = begun.smoothed,
                                               .grant = begun.grant,
                                               .robot_through = begun.robot_through,
                                               .now = 0.1,
                                               .hand_over = 0.2,
                                               .world = std::make_shared<const World>(world_)},
                                              *replanner_.Prepare(world_), random);
  ASSERT_EQ(changed.kind, ProposalKind::kChanged) << changed.reason;
  const int junction = changed.first_changed - 1;
  EXPECT_GT(changed.grant.through, junction);
  const SuperposedWalk before = begun.plan.Walk().StopBranch(junction);
  const SuperposedWalk after = changed.plan.Walk().StopBranch(junction);
  ASSERT_EQ(after.duration(), before.duration());
  for (double t = 0.0; t <= before.duration(); t += 0.01) {
    const WalkJet a = before.At(t), b = after.At(t);
    EXPECT_EQ(a.value, b.value);
    EXPECT_EQ(a.first, b.first);
    EXPECT_EQ(a.second, b.second);
  }
}

}  // namespace
}  // namespace halfstep
