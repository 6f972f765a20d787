#include "experiments/replay/simulated_obstacles.h"

#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include "wpg/check.h"
#include "wpg/files/text.h"

namespace halfstep::replay {
namespace {

using PoseOverTime = std::function<std::optional<Eigen::Isometry3d>(double t)>;

template <typename Primitive>
std::optional<ConvexBody> ConvexOf(const Primitive& shape) {
  return BodyOf(shape);
}
std::optional<ConvexBody> ConvexOf(const TriangleMesh& mesh) {
  try {
    return MakeHull(mesh.vertices);
  } catch (const std::runtime_error&) {
    return std::nullopt;  // flat
  }
}

void Add(const Obstacle& obstacle, PoseOverTime pose, SimulatedObstacles* all) {
  std::optional<ConvexBody> body =
      std::visit([](const auto& shape) { return ConvexOf(shape); }, obstacle.shape);
  if (std::holds_alternative<TriangleMesh>(obstacle.shape)) {
    all->notes.push_back("Obstacle " + Quote(obstacle.name) +
                         (body ? " is simulated as the convex hull of its mesh."
                               : " is not simulated: its mesh is flat."));
  }
  if (body) all->obstacles.push_back({obstacle.name, std::move(*body), std::move(pose)});
}

SimulatedGround GroundOf(const Ground& ground) {
  const double floor = ground.Floor();
  HALFSTEP_CHECK(floor == 0.0 || std::isinf(floor), "a floor at " << floor << " m");
  return {.floor = floor == 0.0, .solids = ground.Solids()};
}

}  // namespace

SimulatedObstacles ObstaclesOf(const Scene& scene) {
  SimulatedObstacles all;
  all.ground = GroundOf(*scene.ground);
  for (const Obstacle& obstacle : scene.obstacles) {
    const auto pose = [X_WO = obstacle.X_WO, motion = obstacle.motion](double t) {
      return std::optional(motion.PoseAt(X_WO, t));
    };
    Add(obstacle, pose, &all);
  }
  return all;
}

SimulatedObstacles ObstaclesOf(const TrueWorld& truth) {
  SimulatedObstacles all;
  all.ground = GroundOf(*truth.scene().ground);
  const auto shared = std::make_shared<const TrueWorld>(truth);
  for (size_t i = 0; i < truth.scene().obstacles.size(); ++i) {
    const auto pose = [shared, i](double t) {
      return shared->IsThere(i, t) ? std::optional(shared->PoseAt(i, t)) : std::nullopt;
    };
    Add(truth.scene().obstacles[i], pose, &all);
  }
  return all;
}

}  // namespace halfstep::replay
