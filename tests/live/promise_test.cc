// Whether the promise of an episode held: what a crate does that was declared to do less.

#include "experiments/live/promise.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/live/judged_promise.h"
#include "experiments/live/promise_words.h"
#include "tests/live/small_episode.h"

namespace halfstep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

// As high as a shin, beside the way. The robot's first steps pass it.
Scene CrateBeside(double speed) {
  Obstacle crate{.name = "crate", .shape = Box{{0.2, 0.2, 0.6}}};
  crate.X_WO.translation() = Eigen::Vector3d(0.5, 1.2, 0.3);
  crate.motion.speed = speed;
  Scene scene;
  scene.obstacles = {crate};
  return scene;
}

// A crate that is carried against the walking robot's leg at 0.8 m/s.
LiveConfig CarriedConfig() {
  LiveConfig config = SmallWorld::Get().config;
  config.live.longest = 12.0;
  config.live.script = {Event(2.0, "carry", "crate", {0.5, 0.1, 0.3}, 0.8)};
  return config;
}

Promise Judged(const PlayedEpisode& played, const Scene& scene, bool truth_is_known = true) {
  Place place = SmallWorld::Get().place;
  place.scene = scene;
  const TrueWorld truth = played.truth->Since(played.episode.waited);
  return JudgePromise(played.episode, truth_is_known ? &truth : nullptr, place, played.config.live);
}

TEST(Promise, HoldsWhereNothingMoves) {
  LiveConfig config = CarriedConfig();
  config.live.script.clear();
  const Scene scene = CrateBeside(0.0);
  const Promise promise = Judged(Play(scene, config), scene);
  EXPECT_EQ(promise.status(), PromiseStatus::kKept);
  EXPECT_EQ(PromiseSentence(promise), "the promise held");
}

TEST(Promise, ACrateThatWasNotDeclaredToMoveBreaksItAndTheKeyThatCoversItIsNamed) {
  const Scene scene = CrateBeside(0.0);
  const PlayedEpisode played = Play(scene, CarriedConfig());
  const Promise promise = Judged(played, scene);
  EXPECT_EQ(promise.status(), PromiseStatus::kTouched);
  EXPECT_EQ(promise.judged_by, "script");
  ASSERT_EQ(promise.broken.size(), 1U);
  const BrokenPromise& crate = promise.broken[0];
  // r is 5 mm: some hundredths of a second after it has begun to move.
  const double begins = 2.0 - played.episode.waited;
  EXPECT_GT(crate.from, begins);
  EXPECT_LT(crate.from, begins + 0.02);
  ASSERT_TRUE(crate.measured && crate.known);
  EXPECT_GE(*crate.measured, crate.from - 0.005);
  EXPECT_GT(*crate.known, *crate.measured);
  EXPECT_GT(crate.beyond, 0.1);
  EXPECT_LE(crate.speed, 0.8 + 1e-9);
  EXPECT_GT(crate.speed, 0.5);
  EXPECT_THAT(crate.covered_by[0], StartsWith("obstacles[crate].motion.speed_m_s: 0."));
  ASSERT_FALSE(crate.unproved.empty());
  EXPECT_LE(crate.unproved.front().begin, crate.from);
  EXPECT_GT(crate.unproved.front().end, *crate.known);
  ASSERT_EQ(promise.touched.size(), 1U);
  EXPECT_EQ(promise.touched[0].obstacle, "crate");
  EXPECT_GT(promise.touched[0].depth, 0.01);
  EXPECT_GT(promise.touched[0].from, crate.from);
  EXPECT_THAT(PromiseSentence(promise), HasSubstr("the robot touched 'crate'"));
  EXPECT_THAT(PromiseText(promise), HasSubstr("obstacles[crate].motion.speed_m_s: 0."));

  // Declared, it is kept, and nothing is touched.
  const Scene declared = CrateBeside(0.8);
  const Promise kept = Judged(Play(declared, CarriedConfig()), declared);
  EXPECT_EQ(kept.status(), PromiseStatus::kKept) << PromiseText(kept);
}

// The robot never learns of it.
TEST(Promise, AJumpThatNoFrameShowsBreaksItToo) {
  LiveConfig config = CarriedConfig();
  ScriptEvent lose = Event(1.9, "lose", "", {});
  lose.lasts = 100.0;
  config.live.script = {lose, Event(2.0, "jump", "crate", {0.5, 0.1, 0.3})};
  const Scene scene = CrateBeside(0.0);
  const PlayedEpisode played = Play(scene, config);
  const Promise promise = Judged(played, scene);
  EXPECT_EQ(promise.status(), PromiseStatus::kTouched);
  ASSERT_EQ(promise.broken.size(), 1U);
  EXPECT_NEAR(promise.broken[0].from, 2.0 - played.episode.waited, 0.005);
  EXPECT_FALSE(promise.broken[0].measured.has_value());
  EXPECT_THAT(PromiseText(promise), HasSubstr("no frame said so"));

  // Measurements alone show nothing.
  const Promise measured = Judged(played, scene, false);
  EXPECT_EQ(measured.judged_by, "measurements");
  EXPECT_EQ(measured.status(), PromiseStatus::kKept);
  EXPECT_THAT(PromiseText(measured), HasSubstr("as far as measurements tell"));
}

TEST(Promise, WhatAppearsIsCoveredByNoKey) {
  LiveConfig config = CarriedConfig();
  config.live.script = {Event(2.0, "appear", "crate", {})};
  const Scene scene = CrateBeside(0.0);
  const Promise promise = Judged(Play(scene, config), scene);
  EXPECT_EQ(promise.status(), PromiseStatus::kNotKept);
  ASSERT_EQ(promise.broken.size(), 1U);
  EXPECT_FALSE(promise.broken[0].was_there);
  EXPECT_THAT(promise.broken[0].covered_by, IsEmpty());
  EXPECT_THAT(PromiseText(promise), HasSubstr("no key covers what was not there"));
  EXPECT_THAT(PromiseText(promise), HasSubstr("\n             nothing was touched\n"));
  EXPECT_THAT(PromiseSentence(promise),
              testing::MatchesRegex("'crate' was not where its error and speed allow, on which the "
                                    "promise rests, from .* s on; nothing was touched"));
}

TEST(Promise, WhatWasTakenToRestAndMovesWithinItsSpeedIsToldByThatKey) {
  LiveConfig config = CarriedConfig();
  config.live.sensing.rests_after = 0.5;
  const Scene scene = CrateBeside(0.8);
  const Promise promise = Judged(Play(scene, config), scene);
  ASSERT_EQ(promise.broken.size(), 1U);
  EXPECT_TRUE(promise.broken[0].rested);
  EXPECT_THAT(promise.broken[0].covered_by, testing::Contains("live.sensing.rests_after_s: none"));
}

TEST(Promise, IsTheSameAgainFromItsJson) {
  const Scene scene = CrateBeside(0.0);
  const Promise promise = Judged(Play(scene, CarriedConfig()), scene);
  const auto json = PromiseJson(promise);
  EXPECT_EQ(PromiseJson(PromiseOf(nlohmann::json::parse(json.dump()))), json);
  EXPECT_THAT(std::vector<std::string>{json["status"]}, ElementsAre("touched"));
}

}  // namespace
}  // namespace halfstep
