#include "experiments/live/world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "experiments/live/past_worlds.h"
#include "tests/live/small_episode.h"

namespace halfstep {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// A frame at t in which a bar with r = 1 cm and v lies at x.
World Frame(double t, double x, double speed) {
  World frame;
  frame.measured_at = t;
  Obstacle bar = Bar("bar", x, 0.0);
  bar.motion = {.waypoints = {}, .error = 0.01, .speed = speed, .measured_at = t, .horizon = 2.0};
  frame.stays = {{bar.X_WO, t}};
  frame.scene.obstacles = {bar};
  return frame;
}

auto Named(const std::string& name) { return testing::Field(&Contradiction::name, name); }

// After one version.
WorldUpdate After(const World& before, World frame, const LiveOptions& options) {
  return Updated(before, PastWorlds({&before, 1}), std::move(frame), options);
}

TEST(World, AnObstacleContradictsBeyondErrorsAndSpeed) {
  const World before = Frame(1.0, 0.0, 0.5);
  EXPECT_THAT(After(before, Frame(1.2, 0.1199, 0.5), {}).contradictions, IsEmpty());
  const WorldUpdate jumped = After(before, Frame(1.2, 0.1201, 0.5), {});
  EXPECT_THAT(jumped.contradictions, ElementsAre(Named("bar")));
  EXPECT_EQ(jumped.world.version, 1);
  EXPECT_EQ(jumped.world.sound_since, 1);
  EXPECT_EQ(After(jumped.world, Frame(1.4, 0.13, 0.5), {}).world.sound_since, 1);
}

// Of a scene what does not move is there unmeasured.
TEST(World, HasTheGroundAndTheFrictionOfItsScene) {
  const SmallWorld& small = SmallWorld::Get();
  Scene scene = small.place.scene;
  scene.friction = 0.3;
  scene.ground = std::make_shared<const FlatGround>(0.1);
  const TrueWorld truth(scene, small.config.experiment.goal, small.config.live);
  std::mt19937_64 random(1);
  const World world = Measure(truth, 0.5, small.config.live, random);
  EXPECT_EQ(world.scene.friction, 0.3);
  EXPECT_EQ(world.scene.ground, scene.ground);
}

TEST(World, ATurnMovesTheFarEnds) {
  const World before = Frame(1.0, 0.0, 0.0);
  World turned = Frame(1.2, 0.0, 0.0);
  turned.scene.obstacles[0].X_WO.rotate(Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitZ()));
  EXPECT_THAT(After(before, turned, {}).contradictions, ElementsAre(Named("bar")));
}

TEST(World, WhatAppearsContradictsAndWhatVanishesDoesNot) {
  World empty;
  const World full = Frame(1.0, 0.0, 0.0);
  EXPECT_THAT(After(empty, full, {}).contradictions, ElementsAre(Named("bar")));
  EXPECT_THAT(After(full, empty, {}).contradictions, IsEmpty());
  World forbidden = empty;
  forbidden.areas = {0};
  forbidden.scene.no_step.resize(1);
  EXPECT_THAT(After(empty, forbidden, {}).contradictions, ElementsAre(Named("no-step area 1")));
}

TEST(World, WhatStaysIsTakenToRestUntilItIsElsewhere) {
  LiveOptions options;
  options.sensing.rests_after = 0.5;
  World world = Frame(1.0, 0.0, 0.5);
  world = After(world, Frame(1.4, 0.015, 0.5), options).world;
  EXPECT_EQ(world.scene.obstacles[0].motion.speed, 0.5);
  world = After(world, Frame(1.5, -0.01, 0.5), options).world;
  EXPECT_EQ(world.scene.obstacles[0].motion.speed, 0.0);
  EXPECT_EQ(world.valid_until(), std::numeric_limits<double>::infinity());
  // It moves off: a contradiction, since it was taken to rest, and it has its speed again.
  const WorldUpdate off = After(world, Frame(1.7, 0.08, 0.5), options);
  EXPECT_THAT(off.contradictions, ElementsAre(Named("bar")));
  EXPECT_EQ(off.world.scene.obstacles[0].motion.speed, 0.5);
  EXPECT_EQ(off.world.valid_until(), 1.7 + 2.0);
}

// Each frame is where the one before allows it; the first world, in which the bar was taken to
// rest, does not allow the last one.
TEST(World, WhatCreepsContradictsAnEarlierWorld) {
  std::vector<World> worlds = {Frame(1.0, 0.0, 0.0)};
  for (const double x : {0.01, 0.019, 0.028}) {
    WorldUpdate next = Updated(worlds.back(), PastWorlds(worlds),
                               Frame(worlds.back().measured_at + 0.2, x, 0.0), LiveOptions{});
    EXPECT_TRUE(After(worlds.back(), next.world, {}).contradictions.empty());
    worlds.push_back(std::move(next.world));
  }
  EXPECT_EQ(worlds[2].sound_since, 0);
  EXPECT_EQ(worlds[3].sound_since, 1);
}

TEST(World, MeasurementsAreWithinTheNoise) {
  Scene scene;
  scene.obstacles = {Bar("bar", 1.0, 0.0)};
  LiveOptions options;
  options.sensing.noise = 0.02;
  const TrueWorld truth(scene, {}, options);
  std::mt19937_64 random(1);
  double farthest = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const World frame = Measure(truth, 0.1 * i, options, random);
    farthest = std::max(farthest, (frame.scene.obstacles[0].X_WO.translation() -
                                   scene.obstacles[0].X_WO.translation())
                                      .norm());
  }
  EXPECT_LE(farthest, 0.02);
  EXPECT_GT(farthest, 0.018);
}

}  // namespace
}  // namespace halfstep
