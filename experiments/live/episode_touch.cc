#include "experiments/live/episode_touch.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/collision/collision_world.h"
#include "wpg/motion/posture.h"

namespace halfstep {
namespace {

Scene SceneAt(const TrueWorld& truth, double t) {
  Scene scene;
  for (size_t i = 0; i < truth.scene().obstacles.size(); ++i) {
    if (!truth.IsThere(i, t)) continue;
    Obstacle obstacle = truth.scene().obstacles[i];
    obstacle.X_WO = truth.PoseAt(i, t);
    obstacle.motion = {};
    scene.obstacles.push_back(std::move(obstacle));
  }
  return scene;
}

bool SamePlaces(const Scene& a, const Scene& b) {
  return std::ranges::equal(a.obstacles, b.obstacles, [](const Obstacle& x, const Obstacle& y) {
    return x.name == y.name && x.X_WO.matrix() == y.X_WO.matrix();
  });
}

}  // namespace

Approach NearestApproach(const Episode& episode, const TrueWorld& truth, const RobotModel& robot,
                         double period, double horizon, bool also_at_rest) {
  Approach nearest{.distance = horizon, .t = 0.0, .obstacle = {}, .body = {}};
  if (episode.walks.empty()) return nearest;
  const SuperposedWalk walk = episode.Executed();
  const double end = also_at_rest ? episode.end : std::min(walk.duration(), episode.end);
  std::vector<CollisionShape> shapes;
  for (const RobotBody& body : robot.bodies) shapes.emplace_back(body.shape);
  Scene scene;
  std::optional<CollisionWorld> world;
  for (long i = 0; static_cast<double>(i) * period <= end; ++i) {
    const double t = static_cast<double>(i) * period;
    const WalkJet jet = walk.At(t);
    if (!also_at_rest && jet.first.isZero(1e-9) && jet.second.isZero(1e-9)) continue;
    // Mostly nothing moves.
    if (Scene now = SceneAt(truth, t); !world || !SamePlaces(now, scene)) {
      scene = std::move(now);
      world.emplace(scene);
    }
    const Posture posture = SolvePosture(robot, jet.value);
    for (size_t b = 0; b < shapes.size(); ++b) {
      const auto found =
          world->FindNearest(shapes[b], posture.OfBody(robot.bodies[b]), t, nearest.distance);
      if (found.obstacle < 0 || found.separation.distance >= nearest.distance) continue;
      nearest = {.distance = found.separation.distance,
                 .t = t,
                 .obstacle = scene.obstacles[static_cast<size_t>(found.obstacle)].name,
                 .body = robot.bodies[b].name};
    }
  }
  return nearest;
}

}  // namespace halfstep
