#include "planner/swept/obstacle_places.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "wpg/files/input_error.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

constexpr double kLongestPart = 0.02;  // [m]
constexpr double kMostParts = 400;

// On [0, until]: |t − t_m| is largest at an end.
double LargestUncertainty(const Obstacle& obstacle, double until) {
  return std::max(obstacle.UncertaintyAt(0.0), obstacle.UncertaintyAt(until));
}

// What is wrong with an obstacle; "": nothing.
std::string WhyUnbounded(const Obstacle& obstacle, double until) {
  if (std::isfinite(LargestUncertainty(obstacle, until))) return "";
  return "obstacle " + Quote(obstacle.name) +
         ": motion.horizon_s: is missing beside a speed, so in time it may be anywhere (valid: a "
         "horizon, when footsteps are to be planned)";
}

}  // namespace

std::vector<ObstaclePlace> PlacesOf(const Obstacle& obstacle, double until) {
  if (const std::string fault = WhyUnbounded(obstacle, until); !fault.empty()) {
    throw InputError({fault});
  }
  const double uncertainty = LargestUncertainty(obstacle, until);
  const ObstacleMotion& motion = obstacle.motion;
  if (motion.waypoints.empty()) return {{obstacle.X_WO, uncertainty}};
  const double radius = RadiusAboutOrigin(obstacle.shape);
  const auto way_until = [&](size_t i, double begin, double end) {
    return motion.SpeedTo(i, obstacle.X_WO, radius) * (end - begin);
  };
  double way = 0.0, begin = 0.0;
  for (size_t i = 0; i < motion.waypoints.size() && begin < until; ++i) {
    const double end = std::min(motion.waypoints[i].t, until);
    way += way_until(i, begin, end);
    begin = end;
  }
  const double longest = std::max(kLongestPart, way / kMostParts);
  std::vector<ObstaclePlace> places;
  begin = 0.0;
  for (size_t i = 0; i < motion.waypoints.size() && begin < until; ++i) {
    const double end = std::min(motion.waypoints[i].t, until);
    const double on_this = way_until(i, begin, end);
    const double parts = std::max(1.0, std::ceil(on_this / longest));
    for (double k = 0.5; k < parts; ++k) {
      const double t = begin + (end - begin) * k / parts;
      places.push_back({obstacle.PoseAt(t), uncertainty + 0.5 * on_this / parts});
    }
    begin = end;
  }
  if (places.empty()) places.push_back({obstacle.X_WO, uncertainty});
  return places;
}

void CheckPlaces(const Scene& scene, double until) {
  std::vector<std::string> complaints;
  for (const Obstacle& obstacle : scene.obstacles) {
    if (std::string fault = WhyUnbounded(obstacle, until); !fault.empty()) {
      complaints.push_back(std::move(fault));
    }
  }
  if (!complaints.empty()) throw InputError(std::move(complaints));
}

}  // namespace halfstep
