#include "experiments/live/past_worlds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/live/small_episode.h"

namespace halfstep {
namespace {

// The same answer by looking at every world.
PastWorlds::Contradiction ByAllPairs(const std::vector<World>& past, const World& now, int since) {
  for (auto earlier = past.rbegin(); earlier != past.rend(); ++earlier) {
    if (earlier->version < since) break;
    PastWorlds::Contradiction found{.version = earlier->version};
    for (const Obstacle& obstacle : now.scene.obstacles) {
      const auto old = std::ranges::find(earlier->scene.obstacles, obstacle.name, &Obstacle::name);
      const bool there = old != earlier->scene.obstacles.end();
      const auto allowed = [&] {
        return old->motion.error + obstacle.motion.error + 1e-9 +
               old->motion.speed * (obstacle.motion.measured_at - old->motion.measured_at);
      };
      if (!there || Displacement(old->X_WO, obstacle.X_WO, obstacle.shape) > allowed()) {
        found.names.push_back(obstacle.name);
      }
    }
    if (!std::ranges::includes(earlier->areas, now.areas)) found.names.push_back("a no-step area");
    if (!found.names.empty()) return found;
  }
  return {};
}

// Five bars, measured within a ball around where they are. One creeps, one jumps and turns now and
// then, one is carried and knows it, one comes and goes, and so does an area.
World Draw(int version, std::mt19937_64& random) {
  std::uniform_real_distribution<double> side(-0.0057, 0.0057);
  const double t = 0.01 * version;
  World world;
  world.version = version;
  world.measured_at = t;
  for (int i = 0; i < 5; ++i) {
    Obstacle bar = Bar("bar " + std::to_string(i), 0.5 * i, 0.0);
    bar.motion = {.waypoints = {}, .error = 0.01, .measured_at = t, .horizon = 2.0};
    auto place = bar.X_WO.translation();
    if (i == 1) place.x() += 0.0001 * version;
    if (i == 2 && version / 500 % 2 == 1) {
      place.x() += 0.05;
      bar.X_WO.rotate(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()));
    }
    if (i == 3) place.x() += 0.3 * t;
    if (i == 3) bar.motion.speed = 0.3;
    place += Eigen::Vector3d(side(random), side(random), side(random));
    if (i == 4 && version / 300 % 2 == 1) continue;
    world.scene.obstacles.push_back(bar);
  }
  if (version / 400 % 2 == 1) world.areas.push_back(0);
  return world;
}

TEST(PastWorlds, AnswersAsAllPairsDo) {
  std::mt19937_64 random(1);
  std::vector<World> worlds;
  PastWorlds past;
  int contradictions = 0, old = 0;
  for (int version = 0; version < 3000; ++version) {
    const World now = Draw(version, random);
    for (const int since : {0, std::max(0, version - 100), version - 1}) {
      const PastWorlds::Contradiction latest = past.Latest(now, since);
      const PastWorlds::Contradiction expected = ByAllPairs(worlds, now, since);
      ASSERT_EQ(latest.version, expected.version) << version << " since " << since;
      ASSERT_EQ(latest.names, expected.names) << version << " since " << since;
      contradictions += latest.version >= 0;
      old += latest.version >= 0 && latest.version < version - 50;
    }
    worlds.push_back(now);
    past.Add(now);
  }
  EXPECT_GT(contradictions, 100);
  EXPECT_GT(old, 100);
}

}  // namespace
}  // namespace halfstep
