#include "tests/benchmarks/sampled_times.h"

#include <algorithm>
#include <cmath>

#include "planner/scene/scene_parts.h"
#include "wpg/motion/half_step_tracks.h"
#include "wpg/motion/posture.h"
#include "wpg/nth.h"

namespace halfstep {

SampledTimes::SampledTimes(const Place& place, const StepSet& set, double clearance)
    : robot_(place.robot),
      set_(set),
      model_(MotionModelOf(place.robot, set.prototype.shape)),
      world_(MovingPart(place.scene)),
      clearance_(clearance),
      scratch_(place.robot.bodies.size()) {
  for (const RobotBody& body : robot_.bodies) shapes_.emplace_back(body.shape);
  const Scene moving = MovingPart(place.scene);
  double settled = 0.0;
  for (const Obstacle& obstacle : moving.obstacles) {
    settled = std::max(settled, obstacle.motion.waypoints.back().t);
  }
  for (int k = 0; k < settled / kTick + 1.0; ++k) {
    boxes_.emplace_back();
    for (const Obstacle& obstacle : moving.obstacles) {
      boxes_.back().push_back(BoundsOf(obstacle.shape, obstacle.PoseAt(k * kTick)));
    }
  }
}

SampledTimes::Ticks SampledTimes::Starts(Kind kind, int i, Side support, const Foothold& X_WS) {
  ++asked_;
  const Samples& samples = SamplesOf(kind, i, support);
  const Eigen::Isometry3d pose = ToIsometry(X_WS);
  const int settled = static_cast<int>(std::ssize(boxes_)) - 1;
  Ticks free;
  free.set();
  for (int k = 0; k <= settled; ++k) {
    if (!NearFromAbove(k, pose.translation(), samples.reach)) continue;
    for (int j = 0; j < std::ssize(samples.X_SBody); ++j) {
      // The last tick stands for all that follow.
      const int first = std::max(0, k - j), last = k == settled ? kTicks - 1 : k - j;
      if (last < 0 || (k < settled && !free[static_cast<size_t>(last)]) ||
          Clears(Nth(samples.X_SBody, j), pose, k)) {
        continue;
      }
      for (int s = first; s <= last; ++s) free.reset(static_cast<size_t>(s));
    }
  }
  return free;
}

bool SampledTimes::NearFromAbove(int k, const Eigen::Vector3d& point, double radius) const {
  return std::ranges::any_of(Nth(boxes_, k), [&](const Eigen::AlignedBox3d& box) {
    return box.exteriorDistance(Eigen::Vector3d(point.x(), point.y(), box.center().z())) <= radius;
  });
}

bool SampledTimes::Near(int k, const Eigen::Vector3d& point, double radius) const {
  return std::ranges::any_of(Nth(boxes_, k), [&](const Eigen::AlignedBox3d& box) {
    return box.exteriorDistance(point) <= radius;
  });
}

bool SampledTimes::Clears(const std::vector<Eigen::Isometry3d>& X_SBody,
                          const Eigen::Isometry3d& X_WS, int k) {
  for (size_t b = 0; b < shapes_.size(); ++b) {
    const Eigen::Isometry3d X_WBody = X_WS * X_SBody[b];
    if (Near(k, X_WBody * shapes_[b].center(), shapes_[b].radius() + clearance_) &&
        !world_.Clears(shapes_[b], X_WBody, k * kTick, clearance_, &scratch_[b])) {
      return false;
    }
  }
  return true;
}

const SampledTimes::Samples& SampledTimes::SamplesOf(Kind kind, int i, Side support) {
  const auto [at, is_new] = samples_.try_emplace({kind, i, static_cast<int>(Index(support))});
  if (!is_new) return at->second;
  const HalfStep half_step = kind == kUp ? set_.Up(i, Opposite(support)) : set_.Down(i, support);
  const HalfStepTracks tracks(half_step, *model_);
  const int ticks = static_cast<int>(std::lround(half_step.duration / kTick));
  Samples& samples = at->second;
  for (int j = kind == kBothFeet ? ticks : 0; j <= (kind == kOneFoot ? 0 : ticks); ++j) {
    const Posture posture = SolvePosture(robot_, tracks.At(j * kTick).value);
    samples.X_SBody.emplace_back();
    for (size_t b = 0; b < shapes_.size(); ++b) {
      const Eigen::Isometry3d& X_SBody = posture.OfBody(robot_.bodies[b]);
      samples.X_SBody.back().push_back(X_SBody);
      const double away = (X_SBody * shapes_[b].center()).head<2>().norm();
      samples.reach = std::max(samples.reach, away + shapes_[b].radius() + clearance_);
    }
  }
  return samples;
}

}  // namespace halfstep
