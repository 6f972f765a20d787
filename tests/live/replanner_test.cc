#include "experiments/live/replanner.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "experiments/live/prepared_world.h"
#include "tests/live/small_episode.h"

namespace halfstep {
namespace {

// The small world's robot, and a first walk to a goal ahead.
struct FirstWalk {
  const SmallWorld& small = SmallWorld::Get();
  const MarginLimits& limits = small.config.experiment.smoothing.limits;
  const Replanner replanner{small.place, small.config, *small.baked.cached.volumes};
  std::mt19937_64 random{1};
  World world;
  Proposal walk;

  explicit FirstWalk(double goal_x, int ahead = 0) {
    world.goal.X_WG = {goal_x, 0.0, 0.0};
    world.goal.radius = 0.15;
    walk = Begin(small.start, ahead);
    EXPECT_EQ(walk.kind, ProposalKind::kChanged) << walk.reason;
    world.version = 1;
  }
  Proposal Begin(const std::array<Foothold, 2>& stance, int ahead = 0) {
    return replanner.Begin(stance, *replanner.Prepare(world), ahead, random);
  }
  // What is proposed when this half-step has begun.
  Proposal Propose(int begun, double now, bool stopped = false, int used_up = 0) {
    return replanner.Propose({.plan = walk.plan,
                              .smoothed = walk.smoothed,
                              .grant = walk.grant,
                              .robot_through = walk.robot_through,
                              .begun = begun,
                              .stopped = stopped,
                              .now = now,
                              .hand_over = now + 0.1,
                              .world = std::make_shared<const World>(world),
                              .used_up = used_up},
                             *replanner.Prepare(world), random);
  }
};

// A walk whose goal has gone where the search cannot get.
TEST(ReplannerTest, AllSearchesOfAProposalShareTheNodes) {
  FirstWalk first(1.2, 4);
  first.world.goal.X_WG.x = 100.0;
  for (const int used_up : {0, 1, 2}) {
    const Proposal proposal = first.Propose(0, 0.1, /*stopped=*/false, used_up);
    EXPECT_EQ(proposal.kind, ProposalKind::kUnsafe);
    EXPECT_EQ(proposal.planned.status, PlanStatus::kBudget);
    EXPECT_EQ(proposal.nodes, first.small.config.experiment.planner.max_nodes);
  }
}

TEST(ReplannerTest, ProvesByTheFrictionOfItsPlace) {
  const SmallWorld& small = SmallWorld::Get();
  for (const double friction : {0.7, 0.001}) {
    Place place = small.place;
    place.scene.friction = friction;
    const Replanner replanner(place, small.config, *small.baked.cached.volumes);
    std::mt19937_64 random(1);
    World world;
    world.scene = place.scene.Emptied();
    world.goal.X_WG = {1.2, 0.0, 0.0};
    world.goal.radius = 0.15;
    const Proposal walk = replanner.Begin(small.start, *replanner.Prepare(world), 0, random);
    EXPECT_EQ(walk.kind, friction == 0.7 ? ProposalKind::kChanged : ProposalKind::kUnsafe);
  }
}

// The least clearance of a walk from begin to end [s].
double LeastClearance(const MarginEvaluator& evaluator, const SuperposedWalk& walk, double begin,
                      double end) {
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  double least = 1.0;
  for (int k = 0; k <= 200; ++k) {
    const LocalTime at = walk.Locate(begin + (end - begin) * k / 200.0);
    least = std::min(
        least,
        evaluator.At(walk, at, &scratch)[static_cast<size_t>(MarginFamily::kClearance)].value);
  }
  return least;
}

// A low box beside the left foot of a robot that rests on both feet after a half-step, so far from
// it [m].
Scene BesideLeftFoot(const WalkPlan& plan, const RobotModel& robot, const MarginLimits& limits,
                     double gap, int half_step = 1) {
  const Foothold foot =
      StanceAfter(plan.sequence, half_step)[static_cast<size_t>(Index(Side::kLeft))];
  const SuperposedWalk walk = plan.Walk();
  Obstacle box{.name = "box", .shape = Box{{0.05, 0.05, 0.04}}};
  box.X_WO.translation() = Eigen::Vector3d(foot.x, foot.y + 0.15, 0.02);
  Scene scene{.name = "box", .files = {}, .obstacles = {box}, .no_step = {}, .warnings = {}};
  for (int i = 0; i < 5; ++i) {
    const MarginEvaluator evaluator(robot, scene, limits);
    const double t = walk.end_of(half_step);
    scene.obstacles[0].X_WO.translation().y() -= LeastClearance(evaluator, walk, t, t) - gap;
  }
  return scene;
}

// Half-steps that begin near an obstacle draw away from it; the others keep what is demanded.
void ExpectDrawsAway(const Proposal& proposal, const Scene& scene, int first) {
  const SmallWorld& small = SmallWorld::Get();
  const MarginLimits& limits = small.config.experiment.smoothing.limits;
  const double demanded = limits.demanded_of(MarginFamily::kClearance);
  ASSERT_NE(proposal.kind, ProposalKind::kUnsafe) << proposal.reason;
  ASSERT_FALSE(proposal.grant.near.empty());
  EXPECT_EQ(proposal.grant.near.front(), first);
  const MarginEvaluator evaluator(small.place.robot, scene, limits);
  const SuperposedWalk walk = proposal.plan.Walk();
  for (int j = first; j <= proposal.grant.through; ++j) {
    const bool near = std::ranges::count(proposal.grant.near, j) > 0;
    const double start = LeastClearance(evaluator, walk, walk.start_of(j), walk.start_of(j));
    const double least = LeastClearance(evaluator, walk, walk.start_of(j), walk.end_of(j));
    EXPECT_GE(least, (near ? std::max(0.0, start - 1e-3) : demanded) - 1e-9) << j;
    EXPECT_EQ(near, start < demanded) << j;
  }
}

// What is demanded cannot be kept where the robot stands. It may go where it gets no nearer than
// that, by 1 mm, as long as it touches nothing.
TEST(ReplannerTest, ARobotThatStandsTooNearDrawsAway) {
  FirstWalk first(1.2);
  const double now = first.walk.plan.Walk().end_of(1) + 1.0;
  for (const double gap : {0.002, -0.001}) {
    first.world.scene = BesideLeftFoot(first.walk.plan, first.small.place.robot, first.limits, gap);
    const Proposal proposal = first.Propose(1, now, /*stopped=*/true);
    if (gap < 0.0) {
      EXPECT_EQ(proposal.kind, ProposalKind::kUnsafe);
      EXPECT_TRUE(proposal.grant.near.empty());
      continue;
    }
    ExpectDrawsAway(proposal, first.world.scene, 2);
  }
}

// Nothing was stopped: the walk has ended, or there was none.
TEST(ReplannerTest, ItDrawsAwayBeforeAFirstWalkAndAfterAFinishedOne) {
  FirstWalk first(0.5);
  const WalkPlan& plan = first.walk.plan;
  const int last = plan.sequence.size() - 1;
  const double now = plan.Walk().duration() + 1.0;
  first.world.goal.X_WG = {1.7, 0.0, 0.0};
  for (const double gap : {0.006, 0.002, -0.001}) {
    first.world.scene = BesideLeftFoot(plan, first.small.place.robot, first.limits, gap, last);
    const Proposal on = first.Propose(last, now);
    const Proposal anew = first.Begin(StanceAfter(plan.sequence, last));
    if (gap > first.limits.demanded_of(MarginFamily::kClearance)) {
      // Swept volumes, which are larger, leave no way.
      EXPECT_NE(on.kind, ProposalKind::kUnsafe);
      EXPECT_NE(anew.kind, ProposalKind::kUnsafe);
      EXPECT_TRUE(on.grant.near.empty() && anew.grant.near.empty());
    } else if (gap > 0.0) {
      ExpectDrawsAway(on, first.world.scene, last + 1);
      ExpectDrawsAway(anew, first.world.scene, 0);
    } else {
      EXPECT_EQ(on.kind, ProposalKind::kUnsafe);
      EXPECT_EQ(anew.kind, ProposalKind::kUnsafe);
    }
  }
}

}  // namespace
}  // namespace halfstep
