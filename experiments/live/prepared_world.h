#pragma once

#include <memory>
#include <utility>

#include "experiments/live/free_half_steps.h"
#include "experiments/live/safety.h"
#include "experiments/live/world.h"
#include "experiments/run/certified_half_steps.h"

namespace halfstep {

/// A world and all that is prepared for questions about it. Immutable, and safe to use from several
/// threads.
struct PreparedWorld {
  /// `half_steps` is borrowed. Clearances and no-step distances are those that the config demands.
  PreparedWorld(std::shared_ptr<const World> w, const RobotModel& robot,
                const ExperimentConfig& config, const FreeHalfSteps& half_steps)
      : held(std::move(w)),
        world(*held),
        safety(robot, world.scene, config),
        certifier(safety.evaluator(), config.smoothing.certification),
        query(half_steps.Among(world.scene)) {}

  const std::shared_ptr<const World> held;  ///< not null
  const World& world;                       ///< the same: what follows borrows it
  const SafetyCheck safety;                 ///< proofs of walks against it
  const HalfStepCertifier certifier;        ///< proofs of isolated half-steps
  /// What of the half-steps is free whenever it is executed; not null.
  const std::unique_ptr<const HalfStepQuery> query;
};

}  // namespace halfstep
