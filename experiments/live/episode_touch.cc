#include "experiments/live/episode_touch.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/collision/collision_world.h"
#include "wpg/motion/posture.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr double kTouch = 1e-3;  // what is nearer is looked at for touches [m]

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

// Whether t is within a half-step that began.
bool IsUnderWay(const SuperposedWalk& walk, const std::vector<BegunHalfStep>& begun, double t) {
  constexpr double kAtRest = 1e-9;  // [s]
  if (begun.empty()) return false;
  // Ends are in order.
  int i = std::min(walk.Locate(t).half_step, begun.back().half_step);
  while (i >= 0 && walk.start_of(i) + kAtRest >= t) --i;
  return i >= 0 && t < walk.end_of(i) - kAtRest;
}

// Calls `visit` of every body of the robot at the multiples of `period` up to `end` at which
// `counts` says so, with the scene as it is then.
template <typename Counts, typename Visit>
void VisitBodies(const SuperposedWalk& walk, const TrueWorld& truth, const RobotModel& robot,
                 double period, double end, const Counts& counts, const Visit& visit) {
  std::vector<CollisionShape> shapes;
  for (const RobotBody& body : robot.bodies) shapes.emplace_back(body.shape);
  Scene scene;
  std::optional<CollisionWorld> world;
  for (long i = 0; static_cast<double>(i) * period <= end; ++i) {
    const double t = static_cast<double>(i) * period;
    const WalkJet jet = walk.At(t);
    if (!counts(t, jet)) continue;
    // Mostly nothing moves.
    if (Scene now = SceneAt(truth, t); !world || !SamePlaces(now, scene)) {
      scene = std::move(now);
      world.emplace(scene);
    }
    const Posture posture = SolvePosture(robot, jet.value);
    for (size_t b = 0; b < shapes.size(); ++b) {
      visit(t, robot.bodies[b].name, shapes[b], posture.OfBody(robot.bodies[b]), scene, *world);
    }
  }
}

// Notes each obstacle that a body touches; the deepest is asked for until none is left.
void AddTouches(double t, const std::string& body, const CollisionShape& shape,
                const Eigen::Isometry3d& X_WB, Scene scene, const CollisionWorld& world,
                std::vector<TouchedObstacle>* touches) {
  auto found = world.FindNearest(shape, X_WB, t, kTouch);
  while (found.obstacle >= 0 && found.separation.distance <= 0.0) {
    const auto obstacle = scene.obstacles.begin() + found.obstacle;
    auto touch = std::ranges::find(*touches, obstacle->name, &TouchedObstacle::obstacle);
    if (touch == touches->end()) {
      touch = touches->insert(touch, {.obstacle = obstacle->name, .body = body, .from = t});
      touch->depth = -1.0;
    }
    if (const double depth = -found.separation.distance; depth > touch->depth) {
      touch->body = body;
      touch->depth = depth;
      touch->deepest = t;
    }
    scene.obstacles.erase(obstacle);
    found = CollisionWorld(scene).FindNearest(shape, X_WB, t, kTouch);
  }
}

}  // namespace

std::vector<TouchedObstacle> FindTouches(const Episode& episode, const TrueWorld& truth,
                                         const RobotModel& robot) {
  std::vector<TouchedObstacle> touches;
  if (episode.walks.empty()) return touches;
  const SuperposedWalk walk = episode.Executed();
  VisitBodies(
      walk, truth, robot, kLook, std::min(walk.duration(), episode.end),
      [&](double t, const WalkJet&) { return IsUnderWay(walk, episode.begun, t); },
      [&](const auto&... at) { AddTouches(at..., &touches); });
  return touches;
}

Approach NearestApproach(const Episode& episode, const TrueWorld& truth, const RobotModel& robot,
                         double period, double cap, bool also_at_rest) {
  Approach nearest{.distance = cap, .t = 0.0, .obstacle = {}, .body = {}};
  if (episode.walks.empty()) return nearest;
  const SuperposedWalk walk = episode.Executed();
  VisitBodies(
      walk, truth, robot, period,
      also_at_rest ? episode.end : std::min(walk.duration(), episode.end),
      [&](double, const WalkJet& jet) {
        return also_at_rest || !jet.first.isZero(1e-9) || !jet.second.isZero(1e-9);
      },
      [&](double t, const std::string& body, const CollisionShape& shape,
          const Eigen::Isometry3d& X_WB, const Scene& scene, const CollisionWorld& world) {
        const auto found = world.FindNearest(shape, X_WB, t, nearest.distance);
        if (found.obstacle < 0 || found.separation.distance >= nearest.distance) return;
        nearest = {.distance = found.separation.distance,
                   .t = t,
                   .obstacle = Nth(scene.obstacles, found.obstacle).name,
                   .body = body};
      });
  return nearest;
}

}  // namespace halfstep
