#include "experiments/live/past_worlds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>

#include "tests/live/small_episode.h"

namespace halfstep {
namespace {

// The same answer by looking at every world.
std::vector<Contradiction> ByAllPairs(const std::vector<World>& past, const World& now, int since) {
  std::vector<Contradiction> all;
  const auto look = [&](const auto& contradicts) {
    for (auto earlier = past.rbegin(); earlier != past.rend(); ++earlier) {
      if (earlier->version < since) return;
      if (const std::optional<Contradiction> found = contradicts(*earlier)) {
        all.push_back(*found);
        return;
      }
    }
  };
  for (const Obstacle& obstacle : now.scene.obstacles) {
    look([&](const World& earlier) -> std::optional<Contradiction> {
      Contradiction found{.name = obstacle.name, .version = earlier.version, .was_there = false};
      const auto old = std::ranges::find(earlier.scene.obstacles, obstacle.name, &Obstacle::name);
      if (old == earlier.scene.obstacles.end()) return found;
      found.was_there = true;
      found.moved = Displacement(old->X_WO, obstacle.X_WO, obstacle.shape);
      found.elapsed = obstacle.motion.measured_at - old->motion.measured_at;
      found.errors = old->motion.error + obstacle.motion.error;
      found.speed = old->motion.speed;
      if (found.moved > found.errors + found.speed * found.elapsed + 1e-9) return found;
      return std::nullopt;
    });
  }
  for (const size_t area : now.areas) {
    look([&](const World& earlier) -> std::optional<Contradiction> {
      if (std::ranges::count(earlier.areas, area) > 0) return std::nullopt;
      return Contradiction{.name = "no-step area " + std::to_string(area + 1),
                           .version = earlier.version,
                           .was_there = false};
    });
  }
  return all;
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
    if (i == 0 && version / 300 % 2 == 1) continue;
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
      const std::vector<Contradiction> latest = past.Latest(now, since);
      ASSERT_EQ(latest, ByAllPairs(worlds, now, since)) << version << " since " << since;
      contradictions += !latest.empty();
      old +=
          std::ranges::any_of(latest, [&](const auto& one) { return one.version < version - 50; });
    }
    worlds.push_back(now);
    past.Add(now);
  }
  EXPECT_GT(contradictions, 100);
  EXPECT_GT(old, 100);
}

}  // namespace
}  // namespace halfstep
