#pragma once

#include <string>
#include <vector>

#include "experiments/config/experiment.h"
#include "experiments/run/baked_half_steps.h"
#include "experiments/run/certified_half_steps.h"
#include "planner/search/footstep_planner.h"
#include "smoothing/proof/certified_feasibility.h"
#include "wpg/geometry/foothold.h"
#include "wpg/robot/not_covered.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// Whether the concatenation keeps every demanded margin for all t; a refusal names the footstep
/// whose half-steps are to blame.
Acceptance CertifyPlan(const CertifiedFeasibility& test, const HalfStepSequence& sequence);

/// A plan and what it was made with.
struct PlannedWalk {
  ExperimentConfig config;  ///< with footsteps and start in place of the goal; when solved
  PlanResult plan;          ///< status, footsteps and work
  /// Without a plan: what start and goal may have wrong (LookAtGoal), which `plan.sentence` begins
  /// with.
  std::vector<std::string> inputs = {};
  /// The set that was searched, with its swept volumes where these said what is free.
  BakedHalfSteps half_steps;
  /// An obstacle that the set's half-steps do not lead over: a way around it was found, or none.
  std::string in_the_way = {};
  /// The keys of half_step that differ from the config's, since its own do not cross the ground, or
  /// an obstacle.
  std::string changed_half_step = {};
  /// Of a way that is longer than the straight one: what no half-step leads over; "": nothing.
  std::string detour = {};
  /// Of half-steps that were called free by proofs (Work::effort), and of searches before this one.
  double proof_effort = 0.0;
  bool on_levels = false;  ///< whether the scene's ground has levels, so that heights are told
  bool in_time = false;    ///< whether obstacles that move counted only where they are then
  std::vector<NotCovered> not_covered = {};  ///< what no proof behind the plan speaks of
};

/// Plans from the config's start to its goal in the place that the config names, and certifies the
/// concatenation. Precondition: config.has_goal (std::logic_error). Throws InputError.
PlannedWalk PlanWalk(const ExperimentConfig& config, const Place& place,
                     const PlanningHooks& hooks);

}  // namespace halfstep
