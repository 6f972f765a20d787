#pragma once

#include "experiments/live/safety.h"
#include "experiments/live/world.h"
#include "experiments/run/planning.h"
#include "planner/swept/swept_volume_query.h"

namespace halfstep {

/// A world and all that is prepared for questions about it. Immutable, and safe to use from several
/// threads.
struct PreparedWorld {
  /// `volumes` is borrowed. Clearances and no-step distances are those that the config demands.
  PreparedWorld(const World& w, const RobotModel& robot, const ExperimentConfig& config,
                const SweptVolumes& volumes)
      : world(w),
        safety(robot, w.scene, config),
        certifier(safety.evaluator(), config.smoothing.certification),
        query(volumes, robot.sole_outline, w.scene,
              config.smoothing.limits.demanded_of(MarginFamily::kNoStep)) {}

  const World world;                  ///< a copy: what follows borrows it
  const SafetyCheck safety;           ///< proofs of walks against it
  const HalfStepCertifier certifier;  ///< proofs of isolated half-steps
  const SweptVolumeQuery query;       ///< of swept volumes, without the obstacles' past
};

}  // namespace halfstep
