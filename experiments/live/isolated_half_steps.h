#pragma once

#include <atomic>
#include <optional>
#include <vector>

#include "experiments/config/experiment_config.h"
#include "experiments/run/planning.h"
#include "planner/swept/swept_volume_query.h"
#include "planner/swept/swept_volumes.h"
#include "smoothing/walk/superposed_walk.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// Proves half-steps of a walk that no other half-step overlaps, by what is known of the set that
/// planners choose from. Such a half-step is the set's own, placed elsewhere: what does not depend
/// on the world is proved once, on an empty floor, and remembered; clearance is what its swept
/// volume says. Const and thread-safe; what is remembered changes no answer.
class IsolatedHalfSteps {
 public:
  /// `volumes` is borrowed. Their clearance is what the config demands.
  IsolatedHalfSteps(const RobotModel& robot, const ExperimentConfig& config,
                    const SweptVolumes& volumes);

  /// Whether half-step j of the walk is one of the set's, nothing overlaps it, and it keeps every
  /// margin that does not depend on the world: proved. When the robot rests behind it, then too.
  bool KeepsOfRobot(const SuperposedWalk& walk, int j) const;
  /// The same for its clearances at all times, in the scene of `query` (of the same volumes), which
  /// has no no-step areas.
  bool Clears(const SuperposedWalk& walk, int j, const SweptVolumeQuery& query) const;

 private:
  // A half-step of the set: what its element's down or up half-step is.
  struct Element {
    int index;
    Side support;       // of the down half-step
    HalfStepKind kind;  // of this one
  };
  // Half-step j; none when it is not of the set or something overlaps it.
  std::optional<Element> Find(const SuperposedWalk& walk, int j) const;

  enum class Known : signed char { kNotAsked, kKept, kNotKept };

  const SweptVolumes& volumes_;
  HalfStepCertifier alone_;  // without obstacles
  mutable std::vector<std::atomic<Known>> kept_;
};

}  // namespace halfstep
