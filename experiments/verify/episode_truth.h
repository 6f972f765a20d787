#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "experiments/live/live_config.h"
#include "planner/scene/scene.h"

namespace halfstep::verify {

/// What truly happened in an episode whose world a script moves: by its own reading of the script,
/// in times of the walk [s]. Frame: that of the walk, in which the world drifts along x at
/// live.drift_m_s. Borrows scene and options.
class EpisodeTruth {
 public:
  /// `scene`: with the boxes to spare. `waited`: when the walk began, a time of the script [s].
  EpisodeTruth(const Scene& scene, const LiveOptions& options, double waited);

  /// Whether an obstacle of the scene is there at t.
  bool IsThere(size_t obstacle, double t) const;
  /// Where it is then.
  Eigen::Isometry3d At(size_t obstacle, double t) const;
  /// Whether a no-step area of the scene is there at t.
  bool AreaIsThere(size_t area, double t) const;

 private:
  const Scene& scene_;
  const LiveOptions& options_;
  double waited_;
  std::vector<std::vector<ScriptEvent>> of_obstacle_;  // in the order of the script
};

}  // namespace halfstep::verify
