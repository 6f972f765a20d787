#include "planner/scene/scene_parts.h"

namespace halfstep {

Scene RestingPart(const Scene& scene) {
  Scene resting = scene;
  std::erase_if(resting.obstacles, [](const Obstacle& obstacle) { return !obstacle.rests(); });
  return resting;
}

Scene MovingPart(const Scene& scene) {
  Scene moving = scene.Emptied();
  for (const Obstacle& obstacle : scene.obstacles) {
    if (!obstacle.rests()) moving.obstacles.push_back(obstacle);
  }
  return moving;
}

}  // namespace halfstep
