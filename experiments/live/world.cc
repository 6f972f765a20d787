#include "experiments/live/world.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ranges>

namespace halfstep {
namespace {

constexpr double kRounding = 1e-9;  // [m]

// How far a point of an obstacle is from where it was measured before, at most [m].
double Displacement(const Obstacle& from, const Obstacle& to) {
  if (to.X_WO.linear() == from.X_WO.linear()) {
    return (to.X_WO.translation() - from.X_WO.translation()).norm();
  }
  const Eigen::AngleAxisd turn(to.X_WO.linear() * from.X_WO.linear().transpose());
  return (to.X_WO.translation() - from.X_WO.translation()).norm() +
         std::abs(turn.angle()) * RadiusAboutOrigin(from.shape);
}

bool Contradicts(const Obstacle& before, const Obstacle& now) {
  const ObstacleMotion &a = before.motion, &b = now.motion;
  const double elapsed = b.measured_at - a.measured_at;
  const double allowed = a.error + b.error + a.speed * elapsed;
  return Displacement(before, now) > allowed + kRounding;
}

// What of a world an earlier one did not allow: names.
std::vector<std::string> Contradictions(const World& earlier, const World& now) {
  std::vector<std::string> names;
  for (size_t i = 0; i < now.scene.obstacles.size(); ++i) {
    const Obstacle& obstacle = now.scene.obstacles[i];
    // Mostly the same obstacles are there in the same order.
    auto old = earlier.scene.obstacles.begin() +
               static_cast<std::ptrdiff_t>(std::min(i, earlier.scene.obstacles.size()));
    if (old == earlier.scene.obstacles.end() || old->name != obstacle.name) {
      old = std::ranges::find(earlier.scene.obstacles, obstacle.name, &Obstacle::name);
    }
    if (old == earlier.scene.obstacles.end() || Contradicts(*old, obstacle)) {
      names.push_back(obstacle.name);
    }
  }
  if (!std::ranges::includes(earlier.areas, now.areas)) names.push_back("a no-step area");
  return names;
}

Eigen::Vector3d InBall(double radius, std::mt19937_64& random) {
  std::uniform_real_distribution<double> side(-1.0, 1.0);
  while (true) {
    const double x = side(random), y = side(random), z = side(random);
    const Eigen::Vector3d p(x, y, z);
    if (p.squaredNorm() <= 1.0) return radius * p;
  }
}

}  // namespace

double World::valid_until() const {
  double until = std::numeric_limits<double>::infinity();
  for (const Obstacle& obstacle : scene.obstacles) {
    const ObstacleMotion& motion = obstacle.motion;
    if (motion.speed > 0.0) until = std::min(until, motion.measured_at + motion.horizon);
  }
  return until;
}

WorldUpdate Updated(std::span<const World> before, World frame, const LiveOptions& options) {
  WorldUpdate update{.world = std::move(frame), .contradictions = {}};
  World& world = update.world;
  const World& last = before.back();
  world.version = last.version + 1;
  world.sound_since = last.sound_since;
  for (const World& earlier : before | std::views::reverse) {
    if (earlier.version < last.sound_since) break;
    update.contradictions = Contradictions(earlier, world);
    if (update.contradictions.empty()) continue;
    world.sound_since = earlier.version + 1;
    break;
  }
  for (size_t i = 0; i < world.scene.obstacles.size(); ++i) {
    Obstacle& now = world.scene.obstacles[i];
    const auto old = std::ranges::find(last.scene.obstacles, now.name, &Obstacle::name);
    if (old == last.scene.obstacles.end()) continue;
    const World::Stay& stay = last.stays[static_cast<size_t>(old - last.scene.obstacles.begin())];
    Obstacle first = now;
    first.X_WO = stay.X_WO;
    const double drifted = options.drift * (now.motion.measured_at - stay.since);
    if (Displacement(first, now) > 2.0 * now.motion.error + drifted + kRounding) continue;
    world.stays[i] = stay;
    const bool rests = options.sensing.rests_after &&
                       now.motion.measured_at - stay.since >= *options.sensing.rests_after;
    if (rests) now.motion.speed = options.drift;
  }
  return update;
}

World Since(World world, double origin) {
  world.measured_at -= origin;
  for (World::Stay& stay : world.stays) stay.since -= origin;
  for (Obstacle& obstacle : world.scene.obstacles) obstacle.motion.measured_at -= origin;
  return world;
}

Obstacle Measured(Obstacle obstacle, const Eigen::Isometry3d& X_WO, double t,
                  const LiveOptions& options) {
  obstacle.X_WO = X_WO;
  obstacle.motion = {.waypoints = {},
                     .error = options.sensing.error,
                     .speed = obstacle.motion.speed + options.drift,
                     .measured_at = t,
                     .horizon = options.horizon};
  return obstacle;
}

World Measure(const TrueWorld& truth, double t, const LiveOptions& options,
              std::mt19937_64& random) {
  World frame;
  frame.measured_at = t;
  frame.goal = truth.GoalAt(t);
  frame.scene.name = truth.scene().name;
  for (size_t i = 0; i < truth.scene().obstacles.size(); ++i) {
    // Drawn for all, so that what one obstacle does changes nothing for the others.
    const Eigen::Vector3d off = InBall(options.sensing.noise, random);
    if (!truth.IsThere(i, t)) continue;
    Eigen::Isometry3d X_WO = truth.PoseAt(i, t);
    X_WO.translation() += off;
    Obstacle obstacle = Measured(truth.scene().obstacles[i], X_WO, t, options);
    frame.stays.push_back({obstacle.X_WO, t});
    frame.scene.obstacles.push_back(std::move(obstacle));
  }
  for (size_t i = 0; i < truth.scene().no_step.size(); ++i) {
    if (!truth.AreaIsThere(i, t)) continue;
    frame.scene.no_step.push_back(truth.scene().no_step[i]);
    frame.areas.push_back(i);
  }
  return frame;
}

}  // namespace halfstep
