#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "experiments/config/experiment_config.h"
#include "experiments/live/world.h"
#include "smoothing/margins/work.h"
#include "smoothing/proof/certified_feasibility.h"
#include "smoothing/walk/superposed_walk.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// How much of a walk that is being executed is safe.
struct Safety {
  /// For every half-step j from the first that was looked at to this one, the walk cut after j
  /// keeps every margin that was looked at until it rests: proved. One less than the first when
  /// that one is refused.
  int through = -1;
  std::optional<Margin> refused_by;  ///< what ended the proof; none when nothing was refused
  Work work = {};                    ///< that it took
};

/// Proves walks against one world. What depends on the robot alone is proved apart from what
/// depends on the obstacles, since the first stays true when the world changes.
class SafetyCheck {
 public:
  /// Limits, margins and the resolution of proofs are those of the config.
  SafetyCheck(const RobotModel& robot, const Scene& scene, const ExperimentConfig& config);

  /// With the scene it was made with.
  const MarginEvaluator& evaluator() const { return evaluator_; }

  /// Whether a half-step is known to keep what is to be proved, so that it need not be.
  using Known = std::function<bool(int half_step)>;

  /// Proves clearances and no-step distances of the walk and its stop branches from `since` [s] on,
  /// half-step after half-step from `first` to `last`, or the walk's last, until one is refused.
  /// While the robot rests it touches nothing by moving: that is not looked at.
  Safety AmongObstacles(const SuperposedWalk& walk, int first, int last, double since,
                        const Known& known = {}) const;
  /// Proves all other margins, in the same way.
  Safety OfRobot(const SuperposedWalk& walk, int first, int last, const Known& known = {}) const;

 private:
  Safety Prove(const SuperposedWalk& walk, int first, int last, double since,
               const std::vector<MarginFamily>& families, const Known& known) const;

  MarginEvaluator evaluator_;
  CertificationOptions options_;
};

/// Whether a family depends on obstacles or no-step areas.
bool DependsOnWorld(MarginFamily family);

}  // namespace halfstep
