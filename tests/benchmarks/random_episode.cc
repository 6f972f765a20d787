#include "tests/benchmarks/random_episode.h"

#include <algorithm>
#include <random>
#include <string>

namespace halfstep {
namespace {

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  double Uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_() >> 11) * 0x1p-53);
  }
  int Integer(int low, int high) {
    return low + static_cast<int>(Uniform(0.0, 1.0) * (high - low + 1) * (1.0 - 1e-12));
  }
  bool Chance(double part) { return Uniform(0.0, 1.0) < part; }

 private:
  std::mt19937_64 random_;
};

// A box, a bar or a cylinder that stands on the floor around (x, y).
Obstacle OnFloor(const std::string& name, double x, double y, Draw* draw) {
  Obstacle obstacle{.name = name, .shape = Box{}};
  double height = 0.0;
  const int kind = draw->Integer(0, 2);
  if (kind == 0) {
    height = draw->Uniform(0.05, 0.5);
    obstacle.shape = Box{{draw->Uniform(0.05, 0.3), draw->Uniform(0.05, 0.3), height}};
  } else if (kind == 1) {
    height = draw->Uniform(0.02, 0.08);
    obstacle.shape = Box{{draw->Uniform(0.02, 0.06), draw->Uniform(0.3, 1.0), height}};
  } else {
    height = draw->Uniform(0.05, 0.8);
    obstacle.shape = Cylinder{draw->Uniform(0.03, 0.15), height};
  }
  obstacle.X_WO.linear() =
      Eigen::AngleAxisd(draw->Uniform(-1.6, 1.6), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  obstacle.X_WO.translation() = Eigen::Vector3d(x, y, 0.5 * height);
  return obstacle;
}

constexpr double kWay = 3.0;         // from the start to the goal [m]
constexpr double kWalkSpeed = 0.15;  // about what the robot makes [m/s]

ScriptEvent Happens(double at, const std::string& what) {
  ScriptEvent event;
  event.at = at;
  event.what = what;
  return event;
}

}  // namespace

RandomEpisode DrawEpisode(const LiveConfig& config, std::uint64_t seed) {
  Draw draw(seed);
  RandomEpisode episode{.config = config, .scene = {}};
  ExperimentConfig& experiment = episode.config.experiment;
  LiveOptions& live = episode.config.live;
  experiment.seed = static_cast<int>(seed % 2147483647);
  experiment.has_goal = true;
  experiment.goal.X_WG = {kWay, draw.Uniform(-0.5, 0.5), 0.0};
  experiment.goal.radius = 0.15;
  episode.scene.name = "episode " + std::to_string(seed);
  const int count = draw.Integer(5, 15);
  for (int i = 0; i < count; ++i) {
    double x = 0.0, y = 0.0;
    do {
      x = draw.Uniform(-0.5, kWay + 0.5);
      y = draw.Uniform(-1.5, 1.5);
    } while (std::hypot(x, y) < 0.8 || std::hypot(x - kWay, y - experiment.goal.X_WG.y) < 0.6);
    episode.scene.obstacles.push_back(OnFloor("obstacle " + std::to_string(i + 1), x, y, &draw));
  }
  constexpr double kRates[] = {5.0, 20.0, 100.0};
  live.sensing.period = 1.0 / kRates[draw.Integer(0, 2)];
  live.sensing.noise = live.sensing.error = draw.Uniform(0.0, 0.02);
  live.sensing.rests_after.reset();
  if (seed % 3 != 0) live.sensing.rests_after = 0.5;
  live.script.clear();
  const int events = draw.Integer(1, 4);
  double at = 0.0;
  for (int i = 0; i < events; ++i) {
    at += draw.Uniform(1.0, 6.0);
    const double kind = draw.Uniform(0.0, 1.0);
    if (kind < 0.2) {
      ScriptEvent goal = Happens(at, "goal");
      goal.goal = {kWay + draw.Uniform(-0.7, 0.3), draw.Uniform(-1.0, 1.0)};
      live.script.push_back(goal);
      continue;
    }
    Obstacle& obstacle = episode.scene.obstacles[static_cast<size_t>(draw.Integer(0, count - 1))];
    // Mostly to where the robot is going.
    const bool ahead = draw.Chance(0.7);
    const double x = ahead ? std::min(kWalkSpeed * at + draw.Uniform(0.5, 1.5), kWay - 0.6)
                           : draw.Uniform(0.0, kWay - 0.6);
    const double y = ahead ? draw.Uniform(-0.3, 0.3) : draw.Uniform(-1.5, 1.5);
    ScriptEvent event = Happens(at, kind < 0.6 ? "jump" : "carry");
    event.obstacle = obstacle.name;
    event.xyz = {x, y, obstacle.X_WO.translation().z()};
    if (event.what == "carry") {
      event.speed = draw.Uniform(0.1, 0.5);
      obstacle.motion.speed = std::max(obstacle.motion.speed, event.speed);
    }
    live.script.push_back(event);
  }
  return episode;
}

}  // namespace halfstep
