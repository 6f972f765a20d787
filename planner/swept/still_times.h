#pragma once

#include "planner/scene/scene.h"
#include "planner/search/half_step_times.h"

namespace halfstep {

/// When no obstacle of a scene moves, nor is known less well as time goes on.
class StillTimes {
 public:
  /// Knows of obstacles that are still on their way after `latest` ≥ 0 [s] only until then.
  StillTimes(const Scene& scene, double latest);

  /// From then on nothing moves [s]; `latest` where something still does.
  double settled() const { return settled_; }
  /// Whether nothing moves after that.
  bool settles() const { return settles_; }
  /// When nothing moves, of [0, settled()].
  const TimeIntervals& before_settled() const { return before_settled_; }

 private:
  double settled_ = 0.0;
  bool settles_ = true;
  TimeIntervals before_settled_;
};

}  // namespace halfstep
