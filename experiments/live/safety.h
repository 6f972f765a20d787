#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "experiments/config/experiment_config.h"
#include "experiments/live/world.h"
#include "smoothing/proof/certified_feasibility.h"
#include "smoothing/walk/superposed_walk.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// How much of a walk that is being executed is safe.
struct Safety {
  /// For every half-step j from the latest that has begun to this one, the walk cut after j keeps
  /// every margin that was looked at from now to its end: proved. One less than the latest that has
  /// begun when not even its own stop branch could be proved.
  int through = -1;
  std::optional<Margin> refused_by;  ///< what ended the proof; none when all half-steps are safe
  bool all(const SuperposedWalk& walk) const { return through + 1 == walk.num_half_steps(); }
};

/// Proves walks against one world. What depends on the robot alone is proved apart from what
/// depends on the obstacles, since the first stays true when the world changes.
class SafetyCheck {
 public:
  SafetyCheck(const RobotModel& robot, const Scene& scene, const ExperimentConfig& config);

  const MarginEvaluator& evaluator() const { return evaluator_; }

  /// Proves clearances and no-step distances of the walk and its stop branches from `now` [s] on,
  /// half-step after half-step from `begun`, the latest that has begun, until one is refused.
  Safety AmongObstacles(const SuperposedWalk& walk, int begun, double now) const;
  /// Proves all other margins of the half-steps from `first` on, in the same way.
  Safety OfRobot(const SuperposedWalk& walk, int first) const;

 private:
  Safety Prove(const SuperposedWalk& walk, int first, double since,
               const std::vector<MarginFamily>& families) const;

  MarginEvaluator evaluator_;
  CertificationOptions options_;
};

/// Whether a family depends on obstacles or no-step areas.
bool DependsOnWorld(MarginFamily family);

}  // namespace halfstep
