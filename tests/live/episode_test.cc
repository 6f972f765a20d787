#include "experiments/live/episode.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

#include "experiments/live/episode_loop.h"
#include "experiments/live/episode_touch.h"
#include "experiments/live/thinker.h"
#include "smoothing/methods/solver_method_options.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/live/small_episode.h"

namespace halfstep {
namespace {

long CountOf(const Episode& episode, const std::string& what) {
  return std::ranges::count(episode.events, what, &EpisodeEvent::what);
}

// Every walk is the executed motion, to the bit, from its hand-over to the next.
void ExpectExecutedWhatWasHandedOver(const Episode& episode) {
  const SuperposedWalk executed = episode.Executed();
  for (size_t k = 0; k < episode.walks.size(); ++k) {
    const double from = episode.walks[k].t;
    const double to = k + 1 < episode.walks.size() ? episode.walks[k + 1].t : episode.end;
    const SuperposedWalk walk = episode.Whole(k).Walk();
    // A walk that had stopped is its own stop branch.
    int begun = 0;
    for (const BegunHalfStep& one : episode.begun) {
      if (executed.start_of(one.half_step) < to) begun = one.half_step;
    }
    const SuperposedWalk branch = walk.StopBranch(std::min(begun, walk.num_half_steps() - 1));
    for (double t = from; t < to; t += 0.05) {
      ASSERT_EQ(executed.At(t).value, branch.At(t).value) << k << " " << t;
      ASSERT_EQ(executed.At(t).second, branch.At(t).second) << k << " " << t;
    }
  }
}

// A bar jumps into the way, and the way is found around it or over it.
PlayedEpisode BarInTheWay(const std::string& policy = "replan") {
  LiveConfig config = SmallWorld::Get().config;
  config.live.policy = policy;
  config.live.script = {Event(1.2, "jump", "bar", {0.75, 0.1, 0.02})};
  Scene scene;
  scene.obstacles = {Bar("bar", 0.75, 2.0)};
  return Play(scene, config);
}

TEST(EpisodeTest, ArrivesWhereNothingHappens) {
  const PlayedEpisode played = Play({}, SmallWorld::Get().config);
  EXPECT_EQ(played.episode.ending, EpisodeEnding::kArrived);
  EXPECT_EQ(CountOf(played.episode, "stopped"), 0);
  EXPECT_EQ(CountOf(played.episode, "contradicted"), 0);
  ExpectExecutedWhatWasHandedOver(played.episode);
}

TEST(EpisodeTest, FindsAnotherWayWhenABarJumpsIntoIt) {
  const PlayedEpisode played = BarInTheWay();
  const Episode& episode = played.episode;
  EXPECT_EQ(episode.ending, EpisodeEnding::kArrived);
  EXPECT_EQ(CountOf(episode, "contradicted"), 1);
  EXPECT_TRUE(std::ranges::any_of(episode.walks, [](const ExecutedWalk& walk) {
    return walk.t > 0.0 && walk.kind == ProposalKind::kChanged;
  }));
  ExpectExecutedWhatWasHandedOver(episode);
  const Approach nearest =
      NearestApproach(episode, *played.truth, SmallWorld::Get().place.robot, 0.01, 0.3);
  EXPECT_GE(nearest.distance, 0.005 - 1e-9);
}

TEST(EpisodeTest, EveryPolicyArrives) {
  for (const std::string policy : {"paper", "stop_and_replan"}) {
    const PlayedEpisode played = BarInTheWay(policy);
    EXPECT_EQ(played.episode.ending, EpisodeEnding::kArrived) << policy << "\n"
                                                              << TablesText(played.episode);
    ExpectExecutedWhatWasHandedOver(played.episode);
  }
}

TEST(EpisodeTest, TheSameAgainToTheByte) {
  const Episode one = BarInTheWay().episode, two = BarInTheWay().episode;
  EXPECT_EQ(TablesText(one), TablesText(two));
}

// At any moment the robot may begin nothing more: what is left of the half-steps under way keeps
// every margin in the world that allowed the latest of them to begin.
TEST(EpisodeTest, CanBeStoppedAtAnyMoment) {
  const PlayedEpisode played = BarInTheWay();
  const Episode& episode = played.episode;
  const SuperposedWalk executed = episode.Executed();
  const ExperimentConfig& config = played.config.experiment;
  std::mt19937_64 random(1);
  for (int i = 0; i < 20; ++i) {
    const size_t k = random() % episode.begun.size();
    const BegunHalfStep& begun = episode.begun[k];
    const Grant& grant = episode.grants[static_cast<size_t>(begun.grant)].grant;
    const Scene& scene = episode.worlds[static_cast<size_t>(grant.version)].scene;
    const MarginEvaluator evaluator(SmallWorld::Get().place.robot, scene, config.smoothing.limits);
    const CertifiedFeasibility test(evaluator, config.smoothing.certification);
    MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
    const SuperposedWalk branch = executed.StopBranch(begun.half_step);
    const TimeSpan span{std::max(grant.proved_at, branch.start_of(begun.half_step)),
                        branch.duration()};
    EXPECT_EQ(test.Check(branch, span, &scratch).verdict, Verdict::kFeasible)
        << "half-step " << begun.half_step + 1;
    EXPECT_LE(grant.version, episode.worlds.back().version);
    EXPECT_GE(grant.through, begun.half_step);
  }
}

TEST(EpisodeTest, WaitsUntilThereIsASafeWalk) {
  LiveConfig config = SmallWorld::Get().config;
  config.live.script = {Event(2.0, "vanish", "bar", {})};
  Scene scene;
  scene.obstacles = {Bar("bar", 0.2, 0.0)};
  scene.obstacles[0].shape = Box{{0.02, 6.0, 1.5}};
  scene.obstacles[0].X_WO.translation().x() = 0.45;
  const PlayedEpisode played = Play(scene, config);
  EXPECT_EQ(played.episode.ending, EpisodeEnding::kArrived);
  EXPECT_NEAR(played.episode.waited, 2.0, 1e-9);
}

// A search with few nodes often fails; nothing in the world changes until the next one.
TEST(EpisodeTest, SearchesAgainInTheSameWorld) {
  LiveConfig config = SmallWorld::Get().config;
  config.experiment.planner.max_nodes = 15;
  const PlayedEpisode played = Play({}, config);
  EXPECT_GT(played.episode.waited, 0.0);
  EXPECT_EQ(played.episode.ending, EpisodeEnding::kArrived);
}

TEST(EpisodeTest, StopsWhenNothingIsMeasuredAnyMore) {
  LiveConfig config = SmallWorld::Get().config;
  ScriptEvent lose = Event(1.0, "lose", "", {});
  lose.lasts = 8.0;
  config.live.script = {lose};
  Scene scene;
  scene.obstacles = {Bar("far", 5.0, 0.0)};
  scene.obstacles[0].motion.speed = 0.3;
  const PlayedEpisode played = Play(scene, config);
  const Episode& episode = played.episode;
  EXPECT_EQ(episode.ending, EpisodeEnding::kArrived);
  ASSERT_EQ(CountOf(episode, "stopped"), 1);
  const auto stopped = std::ranges::find(episode.events, "stopped", &EpisodeEvent::what);
  // No half-step ends after the horizon of the last frame, and the walk goes on afterwards.
  EXPECT_LE(episode.Executed().end_of(stopped->half_step), 1.0 + config.live.horizon + 1e-9);
  EXPECT_GT(episode.end, 9.0);
  EXPECT_TRUE(std::ranges::any_of(episode.walks, [](const ExecutedWalk& walk) {
    return walk.kind == ProposalKind::kResumed || walk.t > 9.0;
  }));
  ExpectExecutedWhatWasHandedOver(episode);
}

TEST(EpisodeTest, AGoalThatMovesIsFollowed) {
  LiveConfig config = SmallWorld::Get().config;
  ScriptEvent goal = Event(2.0, "goal", "", {});
  goal.goal = {0.9, 0.4};
  config.live.script = {goal};
  const PlayedEpisode played = Play({}, config);
  EXPECT_EQ(played.episode.ending, EpisodeEnding::kArrived);
  const WalkPlan last = played.episode.Whole(played.episode.walks.size() - 1);
  EXPECT_TRUE(played.truth->GoalAt(10.0).ContainsStance(
      StanceAfter(last.sequence, played.episode.begun.back().half_step)));
}

// Control: a box that is carried into the way unseen, at a speed that was denied, is walked into.
TEST(EpisodeTest, AnUnderstatedSpeedIsTouched) {
  LiveConfig config = SmallWorld::Get().config;
  ScriptEvent lose = Event(1.0, "lose", "", {});
  lose.lasts = 30.0;
  config.live.script = {lose, Event(2.0, "carry", "wall", {0.55, 0.0, 0.4}, 1.0)};
  Scene scene;
  scene.obstacles = {Bar("wall", 0.55, 2.0)};
  scene.obstacles[0].shape = Box{{0.1, 1.0, 0.8}};
  scene.obstacles[0].X_WO.translation().z() = 0.4;
  const auto touch = [&] {
    const PlayedEpisode played = Play(scene, config);
    return NearestApproach(played.episode, *played.truth, SmallWorld::Get().place.robot, 0.01, 0.3);
  };
  EXPECT_LT(touch().distance, 0.0);
  // The same with its speed told: the robot stops in time.
  scene.obstacles[0].motion.speed = 1.0;
  EXPECT_GE(touch().distance, 0.005 - 1e-9);
}

// Answers half a second later than the budget says, as a machine that is too slow does.
class SlowThinker final : public Thinker {
 public:
  SlowThinker(const Replanner& replanner, std::uint64_t seed) : thinker_(replanner, seed) {}
  void Ask(Situation situation) override { thinker_.Ask(std::move(situation)); }
  std::optional<Proposal> Answer(double now) override { return thinker_.Answer(now - 0.5); }

 private:
  LockstepThinker thinker_;
};

// Its successors come too late at first; then more time is left for them.
TEST(EpisodeTest, ASlowMachineArrivesToo) {
  LiveConfig config = SmallWorld::Get().config;
  config.live.script = {Event(1.2, "jump", "bar", {0.75, 0.1, 0.02})};
  Scene scene;
  scene.obstacles = {Bar("bar", 0.75, 2.0)};
  const SmallWorld& small = SmallWorld::Get();
  const TrueWorld truth(scene, config.experiment.goal, config.live);
  const Replanner replanner(small.place, config, *small.baked.cached.volumes);
  SlowThinker thinker(replanner, 1);
  StandInSensor sensor(truth, config.live, 1);
  EpisodeClock clock;
  const Episode episode = EpisodeLoop(replanner, &sensor, &thinker, &clock, {}).Run(small.start);
  EXPECT_EQ(episode.ending, EpisodeEnding::kArrived) << TablesText(episode);
  EXPECT_GT(CountOf(episode, "refused"), 0);
  EXPECT_TRUE(std::ranges::any_of(episode.walks, [](const ExecutedWalk& walk) {
    return walk.t > 0.0 && walk.kind == ProposalKind::kChanged;
  }));
  ExpectExecutedWhatWasHandedOver(episode);
}

// Time that passes by itself, three seconds of it while the first walk is looked for.
class SlowOnceClock final : public EpisodeClock {
 public:
  void Begin() override { now_ = 0.0; }
  void WaitUntil(double t) override { now_ = std::max(now_, t); }
  double Time(double /*now*/) const override {
    if (++calls_ == 2) now_ += 3.0;
    return now_;
  }
  bool passes() const override { return true; }

 private:
  mutable int calls_ = 0;
  mutable double now_ = 0.0;
};

// So much time is left for the second search that what is measured would be too old at its end;
// for the third no more than the second took.
TEST(EpisodeTest, ASlowSearchAtTheBeginningIsForgotten) {
  const SmallWorld& small = SmallWorld::Get();
  Scene scene;
  scene.obstacles = {Bar("bar", 0.75, 2.0)};
  scene.obstacles[0].motion.speed = 0.05;
  const TrueWorld truth(scene, small.config.experiment.goal, small.config.live);
  const Replanner replanner(small.place, small.config, *small.baked.cached.volumes);
  LockstepThinker thinker(replanner, 1);
  StandInSensor sensor(truth, small.config.live, 1);
  SlowOnceClock clock;
  const Episode episode = EpisodeLoop(replanner, &sensor, &thinker, &clock, {}).Run(small.start);
  EXPECT_EQ(episode.ending, EpisodeEnding::kArrived) << episode.message;
  EXPECT_GT(episode.waited, 3.0);
  EXPECT_LT(episode.waited, 5.0);
}

TEST(EpisodeTest, ByTheWallClockItArrivesToo) {
  LiveConfig config = SmallWorld::Get().config;
  config.live.clock = "wall";
  config.experiment.goal.X_WG.x = 0.35;
  const PlayedEpisode played = Play({}, config);
  EXPECT_EQ(played.episode.ending, EpisodeEnding::kArrived);
  ExpectExecutedWhatWasHandedOver(played.episode);
}

}  // namespace
}  // namespace halfstep
