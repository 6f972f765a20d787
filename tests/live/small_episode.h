#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "experiments/config/experiment.h"
#include "experiments/live/episode.h"
#include "experiments/live/episode_tables.h"
#include "experiments/live/live_config.h"
#include "experiments/live/replanner.h"
#include "experiments/run/planning.h"
#include "tests/places.h"

namespace halfstep {

/// The config of the small world.
inline const std::string kSmallConfig =
    "robot: hrp2\n"
    "scene: none\n"
    "goal: {x_m: 1.2, y_m: 0, radius_m: 0.15}\n"
    "half_step: {duration_s: 1.5, zmp_shift_s: 0.075}\n"
    "smoothing: {margins: {double_support_s: 0.075}}\n"
    "step_set: {x_min_m: -0.1, x_max_m: 0.2, y_min_m: -0.29, y_max_m: -0.21,\n"
    "           spacing_m: 0.08, yaws_rad: [-0.25, 0, 0.25]}\n"
    "swept_volumes: {cell_m: 0.03, displacement_m: 0.02,\n"
    "                cache: " +
    InBuild("swept_volumes_of_tests") +
    "}\n"
    "planner: {unimproved_nodes: 100, max_nodes: 2000}\n"
    "live: {smooth_ahead: 4, tolerance_s: 0.1, longest_s: 60}\n";

/// HRP-2 with a dozen half-steps on coarse cells, which are baked once for all tests of a program.
struct SmallWorld {
  LiveConfig config;
  Place place;
  BakedHalfSteps baked;
  std::array<Foothold, 2> start;

  static const SmallWorld& Get() {
    static const SmallWorld world = [] {
      SmallWorld made;
      made.config = ParseLiveConfig("small.yaml", kSmallConfig, {});
      made.place = LoadPlace(made.config.experiment);
      made.baked = BakeHalfSteps(made.place.robot, made.config.experiment, {});
      made.start = StartOf(made.config.experiment, made.place.robot, *made.place.scene.ground);
      return made;
    }();
    return world;
  }
};

/// A bar on the floor across the way, its middle at (x, y).
inline Obstacle Bar(const std::string& name, double x, double y) {
  Obstacle bar{.name = name, .shape = Box{{0.03, 0.3, 0.04}}};
  bar.X_WO.translation() = Eigen::Vector3d(x, y, 0.02);
  return bar;
}

inline ScriptEvent Event(double at, const std::string& what, const std::string& obstacle,
                         const std::vector<double>& xyz, double speed = 0.0) {
  ScriptEvent event;
  event.at = at;
  event.what = what;
  event.obstacle = obstacle;
  event.xyz = xyz;
  event.speed = speed;
  return event;
}

/// An episode of the small world in a scene, by a script.
struct PlayedEpisode {
  LiveConfig config;
  std::unique_ptr<TrueWorld> truth;
  std::unique_ptr<Replanner> replanner;
  Episode episode;
};
inline PlayedEpisode Play(const Scene& scene, const LiveConfig& config,
                          const EpisodeHooks& hooks = {}) {
  const SmallWorld& small = SmallWorld::Get();
  PlayedEpisode played{.config = config, .truth = nullptr, .replanner = nullptr, .episode = {}};
  played.truth = std::make_unique<TrueWorld>(scene, config.experiment.goal, config.live);
  played.replanner = std::make_unique<Replanner>(small.place, config, *small.baked.cached.volumes);
  const auto run = config.live.clock == "wall" ? RunWallClock : RunLockstep;
  StandInSensor sensor(*played.truth, config.live,
                       static_cast<std::uint64_t>(config.experiment.seed) + 1);
  played.episode = run(*played.replanner, &sensor, small.start, hooks);
  return played;
}

/// All tables of an episode but what computing took.
inline std::string TablesText(const Episode& episode) {
  std::string text;
  for (const EpisodeTable& table : EpisodeTables(episode, {})) {
    if (table.name != "timings") text += table.name + "\n" + table.file.text;
  }
  for (size_t walk = 0; walk < episode.walks.size(); ++walk) {
    for (const EpisodeTable& table : WalkTables(episode, walk)) text += table.file.text;
  }
  return text;
}

}  // namespace halfstep
