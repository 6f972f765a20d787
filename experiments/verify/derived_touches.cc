#include "experiments/verify/derived_touches.h"

#include <algorithm>
#include <map>
#include <string>

#include "experiments/verify/distances.h"

namespace halfstep::verify {

std::vector<TouchText> TouchesOf(const EpisodeText& episode, const DescribedWalk& walk,
                                 double episode_end, const Scene& all, const EpisodeTruth& truth) {
  constexpr double kNear = 1e-3;  // farther bodies are not measured [m]
  constexpr double kEdge = 1e-9;  // of a half-step [s]
  Scene scene = all;              // its obstacles are moved under `distances`, which borrows it
  for (Obstacle& obstacle : scene.obstacles) obstacle.motion = {};
  Distances distances(walk.robot(), scene);
  std::map<std::string, double> first;
  const double end = std::min(walk.end(), episode_end);
  for (long i = 0; static_cast<double>(i) * kLook <= end; ++i) {
    const double t = static_cast<double>(i) * kLook;
    bool under_way = false;
    for (const BegunRow& begun : episode.begun) {
      const auto [from, until] = walk.WindowOf(begun.half_step - 1);
      under_way = under_way || (from + kEdge < t && t < until - kEdge);
    }
    if (!under_way) continue;
    const Placement at = PlaceRobot(walk.robot(), walk.Row(t));
    for (size_t o = 0; o < scene.obstacles.size(); ++o) {
      if (first.contains(scene.obstacles[o].name) || !truth.IsThere(o, t)) continue;
      scene.obstacles[o].X_WO = truth.At(o, t);
      for (size_t b = 0; b < distances.num_bodies(); ++b) {
        if (distances.FromObstacle(b, o, at, t, kNear).distance > 0) continue;
        first[scene.obstacles[o].name] = t;
        break;
      }
    }
  }
  std::vector<TouchText> touches;
  for (const auto& [name, t] : first) touches.push_back({name, t});
  return touches;
}

}  // namespace halfstep::verify
