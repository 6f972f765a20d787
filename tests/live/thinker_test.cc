#include "experiments/live/thinker.h"

#include <gtest/gtest.h>

#include "experiments/live/prepared_world.h"
#include "tests/live/small_episode.h"

namespace halfstep {
namespace {

constexpr double kPerEffort = 0.7;  // [s]

LiveConfig Counted() {
  LiveConfig config = SmallWorld::Get().config;
  config.live.budget.effort = kPerEffort;
  return config;
}

// A safe walk of the small world whose overlaps are not found yet.
struct Unsmoothed {
  const SmallWorld& small = SmallWorld::Get();
  const Replanner replanner{small.place, Counted(), *small.baked.cached.volumes};

  Situation situation() const {
    World world;
    world.goal.X_WG = {1.2, 0.0, 0.0};
    world.goal.radius = 0.15;
    std::mt19937_64 random(1);
    const Proposal first = replanner.Begin(small.start, *replanner.Prepare(world), 0, random);
    EXPECT_EQ(first.kind, ProposalKind::kChanged) << first.reason;
    world.version = 1;
    return {.plan = first.plan,
            .smoothed = first.smoothed,
            .grant = first.grant,
            .robot_through = first.robot_through,
            .now = 0.1,
            .hand_over = 0.2,
            .world = std::make_shared<const World>(world)};
  }
};

TEST(ThinkerTest, InLockstepAnswersComeAfterTheirEffort) {
  const Unsmoothed walk;
  LockstepThinker thinker(walk.replanner, 1);
  thinker.Ask(walk.situation());
  const std::optional<Proposal> early = thinker.Answer(0.1);
  EXPECT_FALSE(early);
  const std::optional<Proposal> answer = thinker.Answer(100.0);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->kind, ProposalKind::kSmoothed);
  const double ready = 0.1 + kPerEffort * answer->effort.all();
  thinker.Ask(walk.situation());
  EXPECT_FALSE(thinker.Answer(ready - 1e-9));
  EXPECT_TRUE(thinker.Answer(ready));
}

// Whoever hurries gets the safe walk as it is, no earlier than asked for, and sooner.
TEST(ThinkerTest, HurriedItLeavesOutWhatOnlyImproves) {
  const Unsmoothed walk;
  LockstepThinker thinker(walk.replanner, 1);
  thinker.Ask(walk.situation());
  const double patient = 0.1 + kPerEffort * thinker.Answer(100.0)->effort.all();
  thinker.Ask(walk.situation());
  thinker.Hurry(0.101);
  EXPECT_FALSE(thinker.Answer(0.1));
  const std::optional<Proposal> answer = thinker.Answer(0.5 * (0.101 + patient));
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->kind, ProposalKind::kSafe);
  EXPECT_EQ(answer->plan.parameters.overlaps, walk.situation().plan.parameters.overlaps);
  EXPECT_EQ(answer->grant.version, 1);
}

TEST(ThinkerTest, AThreadThatIsHurriedAnswersAndGoesOn) {
  const Unsmoothed walk;
  ThreadThinker thinker(walk.replanner, 1);
  const auto wait = [&] {
    while (true) {
      if (std::optional<Proposal> answer = thinker.Answer(0.0)) return *answer;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  };
  thinker.Ask(walk.situation());
  thinker.Hurry(0.1);
  // It may have been done before.
  const ProposalKind hurried = wait().kind;
  EXPECT_TRUE(hurried == ProposalKind::kSafe || hurried == ProposalKind::kSmoothed);
  thinker.Ask(walk.situation());
  EXPECT_EQ(wait().kind, ProposalKind::kSmoothed);
}

// Among obstacles that change all the time the walk is smoothed all the same, and the same twice.
TEST(ThinkerTest, EpisodesThatCountTheirEffortAreTheSameAgain) {
  LiveConfig config = Counted();
  config.live.script = {Event(1.2, "jump", "bar", {0.75, 0.1, 0.02}),
                        Event(1.4, "carry", "far", {3.0, -2.0, 0.02}, 0.3)};
  Scene scene;
  scene.obstacles = {Bar("bar", 0.75, 2.0), Bar("far", 3.0, 2.0)};
  scene.obstacles[1].motion.speed = 0.3;
  const Episode episode = Play(scene, config).episode;
  EXPECT_EQ(episode.ending, EpisodeEnding::kArrived);
  int smoothed = 0;
  for (const ExecutedWalk& walk : episode.walks) {
    smoothed += walk.kind == ProposalKind::kSmoothed;
    if (walk.t > 0.0 && walk.kind == ProposalKind::kSmoothed) {
      EXPECT_GE(walk.t, walk.asked + kPerEffort * walk.effort - 1e-9);
    }
  }
  EXPECT_GT(smoothed, 0);
  EXPECT_EQ(TablesText(episode), TablesText(Play(scene, config).episode));
}

}  // namespace
}  // namespace halfstep
