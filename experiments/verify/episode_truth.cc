#include "experiments/verify/episode_truth.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace halfstep::verify {

EpisodeTruth::EpisodeTruth(const Scene& scene, const LiveOptions& options, double waited)
    : scene_(scene), options_(options), waited_(waited), of_obstacle_(scene.obstacles.size()) {
  for (const ScriptEvent& event : options.script) {
    for (size_t i = 0; i < scene.obstacles.size(); ++i) {
      if (scene.obstacles[i].name == event.obstacle) of_obstacle_[i].push_back(event);
    }
  }
}

bool EpisodeTruth::IsThere(size_t obstacle, double t) const {
  // A box to spare, and what appears at some time, is not there from the beginning.
  const std::ptrdiff_t own = std::ssize(scene_.obstacles) - options_.spare_boxes;
  bool there = static_cast<std::ptrdiff_t>(obstacle) < own;
  for (const ScriptEvent& event : of_obstacle_[obstacle]) {
    if (event.what == "appear") there = false;
  }
  for (const ScriptEvent& event : of_obstacle_[obstacle]) {
    const bool happened = event.at - waited_ <= t;
    if (happened && event.what == "appear") there = true;
    if (happened && event.what == "vanish") there = false;
  }
  return there;
}

Eigen::Isometry3d EpisodeTruth::At(size_t obstacle, double t) const {
  Eigen::Isometry3d X = scene_.obstacles[obstacle].X_WO;
  Eigen::Vector3d place = X.translation();
  double yaw = 0;
  const std::vector<ScriptEvent>& events = of_obstacle_[obstacle];
  for (size_t k = 0; k < events.size(); ++k) {
    const double begin = events[k].at - waited_;
    if (begin > t) break;
    if (events[k].what != "jump" && events[k].what != "carry") continue;
    // The next event of this obstacle ends that it is carried.
    double end = t;
    if (k + 1 < events.size()) end = std::min(end, events[k + 1].at - waited_);
    const Eigen::Vector3d to(events[k].xyz[0], events[k].xyz[1], events[k].xyz[2]);
    const double way = (to - place).norm();
    double part = 1;
    if (events[k].what == "carry" && way > 0) {
      part = std::min(1.0, (end - begin) * events[k].speed / way);
    }
    place = (1 - part) * place + part * to;
    yaw += part * events[k].turn;
  }
  const double c = std::cos(yaw), s = std::sin(yaw);
  Eigen::Matrix3d turn;
  turn << c, -s, 0, s, c, 0, 0, 0, 1;
  X.linear() = turn * X.linear();
  place.x() += options_.drift * (t + waited_);
  X.translation() = place;
  return X;
}

bool EpisodeTruth::AreaIsThere(size_t area, double t) const {
  bool there = true;
  for (const ScriptEvent& event : options_.script) {
    if (event.what != "forbid" || event.area != static_cast<int>(area) + 1) continue;
    there = event.at - waited_ <= t;
  }
  return there;
}

}  // namespace halfstep::verify
