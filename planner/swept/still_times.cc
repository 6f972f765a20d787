#include "planner/swept/still_times.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "planner/scene/scene_parts.h"
#include "wpg/check.h"

namespace halfstep {
namespace {

// From when on an obstacle is where it stays [s]; ∞: never.
double SettlesAt(const Obstacle& obstacle) {
  const ObstacleMotion& motion = obstacle.motion;
  const double arrives = motion.waypoints.empty() ? 0.0 : motion.waypoints.back().t;
  const double known = motion.speed == 0.0 ? 0.0 : motion.measured_at + motion.horizon;
  return std::max({0.0, arrives, known});
}

// When an obstacle begins or ceases to move, or to be known less well, in any order [s].
std::vector<double> ChangesOf(const ObstacleMotion& motion) {
  std::vector<double> changes;
  for (const ObstacleMotion::Waypoint& waypoint : motion.waypoints) changes.push_back(waypoint.t);
  if (motion.speed > 0.0) {
    for (const double since : {-motion.horizon, 0.0, motion.horizon}) {
      changes.push_back(motion.measured_at + since);
    }
  }
  return changes;
}

// Whether pose and uncertainty are the same from one change to the next: what holds in the middle
// holds all the time.
bool RestsBetween(const Obstacle& obstacle, double begin, double end) {
  const ObstacleMotion& motion = obstacle.motion;
  const double mid = 0.5 * (begin + end);
  const auto ahead =
      std::ranges::upper_bound(motion.waypoints, mid, {}, &ObstacleMotion::Waypoint::t);
  const auto index = static_cast<size_t>(ahead - motion.waypoints.begin());
  const bool stays =
      index == motion.waypoints.size() || motion.SpeedTo(index, obstacle.X_WO, 1.0) == 0.0;
  return stays && motion.UncertaintyRateAt(mid) == 0.0;
}

}  // namespace

StillTimes::StillTimes(const Scene& scene, double latest) {
  HALFSTEP_CHECK(latest >= 0.0, "latest = " << latest);
  const std::vector<Obstacle> moving = MovingPart(scene).obstacles;
  for (const Obstacle& obstacle : moving) settled_ = std::max(settled_, SettlesAt(obstacle));
  settles_ = settled_ <= latest;
  settled_ = std::min(settled_, latest);
  std::vector<double> changes = {0.0, settled_};
  for (const Obstacle& obstacle : moving) {
    for (const double t : ChangesOf(obstacle.motion)) {
      if (t > 0.0 && t < settled_) changes.push_back(t);
    }
  }
  std::ranges::sort(changes);
  for (size_t i = 0; i + 1 < changes.size(); ++i) {
    const double begin = changes[i], end = changes[i + 1];
    if (begin < end && std::ranges::all_of(moving, [&](const Obstacle& obstacle) {
          return RestsBetween(obstacle, begin, end);
        })) {
      before_settled_.push_back({begin, end});
    }
  }
}

}  // namespace halfstep
