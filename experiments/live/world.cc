#include "experiments/live/world.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "experiments/live/past_worlds.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

constexpr double kRounding = 1e-9;  // [m]

// The obstacle of that name. Mostly obstacles are there in the same order: `likely` is where it is
// looked for first, and then the next one.
std::optional<size_t> Find(const std::vector<Obstacle>& obstacles, const std::string& name,
                           size_t* likely) {
  for (size_t tried = 0; tried < obstacles.size(); ++tried) {
    const size_t k = (*likely + tried) % obstacles.size();
    if (obstacles[k].name != name) continue;
    *likely = k + 1;
    return k;
  }
  return {};
}

bool SameGoal(const GoalRegion& a, const GoalRegion& b) {
  return a.X_WG.x == b.X_WG.x && a.X_WG.y == b.X_WG.y;
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

bool DiffersClearly(const World& a, const World& b) {
  constexpr double kClear = 0.01;  // [m]
  if (!SameGoal(a.goal, b.goal) || a.areas != b.areas) return true;
  if (!SameCourse(a.course, b.course)) return true;
  return !std::ranges::equal(
      a.scene.obstacles, b.scene.obstacles, [](const Obstacle& x, const Obstacle& y) {
        const double moved = (x.X_WO.translation() - y.X_WO.translation()).norm();
        return x.name == y.name && x.motion.speed == y.motion.speed &&
               moved <= x.motion.error + y.motion.error + kClear;
      });
}

std::string Contradiction::Text() const {
  if (!was_there) return name + Formatted(": was not there in world %d", version);
  return name + Formatted(": %.4g m from where world %d had it %.4g s before, %.4g m are allowed",
                          moved, version, elapsed, allowed());
}

WorldUpdate Updated(const World& last, const PastWorlds& past, World frame,
                    const LiveOptions& options) {
  WorldUpdate update{.world = std::move(frame), .contradictions = {}};
  World& world = update.world;
  world.version = last.version + 1;
  world.sound_since = last.sound_since;
  update.contradictions = past.Latest(world, last.sound_since);
  for (const Contradiction& one : update.contradictions) {
    world.sound_since = std::max(world.sound_since, one.version + 1);
  }
  size_t likely = 0;
  for (size_t i = 0; i < world.scene.obstacles.size(); ++i) {
    Obstacle& now = world.scene.obstacles[i];
    const std::optional<size_t> old = Find(last.scene.obstacles, now.name, &likely);
    if (!old) continue;
    const World::Stay& stay = last.stays[*old];
    const double drifted = options.drift * (now.motion.measured_at - stay.since);
    if (Displacement(stay.X_WO, now.X_WO, now.shape) >
        2.0 * now.motion.error + drifted + kRounding) {
      continue;
    }
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
  frame.course = truth.CourseAt(t);
  frame.scene = truth.scene().Emptied();
  frame.scene.obstacles.reserve(truth.scene().obstacles.size());
  frame.stays.reserve(truth.scene().obstacles.size());
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
