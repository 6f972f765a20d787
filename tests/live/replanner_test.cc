#include "experiments/live/replanner.h"

#include <gtest/gtest.h>

#include "experiments/live/prepared_world.h"
#include "tests/live/small_episode.h"

namespace halfstep {
namespace {

// A walk whose goal has gone where the search cannot get.
TEST(ReplannerTest, AllSearchesOfAProposalShareTheNodes) {
  const SmallWorld& small = SmallWorld::Get();
  const Replanner replanner(small.place.robot, small.config, *small.baked.cached.volumes);
  std::mt19937_64 random(1);
  World world;
  world.goal.X_WG = {1.2, 0.0, 0.0};
  world.goal.radius = 0.15;
  const Proposal walk = replanner.Begin(small.start, *replanner.Prepare(world), 4, random);
  ASSERT_EQ(walk.kind, ProposalKind::kChanged) << walk.reason;
  world.version = 1;
  world.goal.X_WG.x = 100.0;
  for (const int used_up : {0, 1, 2}) {
    const Proposal proposal = replanner.Propose({.plan = walk.plan,
                                                 .smoothed = walk.smoothed,
                                                 .grant = walk.grant,
                                                 .robot_through = walk.robot_through,
                                                 .now = 0.1,
                                                 .hand_over = 0.2,
                                                 .world = nullptr,
                                                 .used_up = used_up},
                                                *replanner.Prepare(world), random);
    EXPECT_EQ(proposal.kind, ProposalKind::kUnsafe);
    EXPECT_EQ(proposal.planned.status, PlanStatus::kBudget);
    EXPECT_EQ(proposal.nodes, small.config.experiment.planner.max_nodes);
  }
}

}  // namespace
}  // namespace halfstep
