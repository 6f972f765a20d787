#pragma once

#include <functional>
#include <memory>

#include "experiments/config/experiment.h"
#include "planner/search/step_set.h"
#include "smoothing/proof/certified_feasibility.h"
#include "wpg/geometry/foothold.h"
#include "wpg/ground/ground.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// Proves one isolated half-step of a robot in a scene, its support sole at X_WS: every demanded
/// margin for all t.
class HalfStepCertifier {
 public:
  /// Margins, the resolution and the pendulum are those of the config.
  HalfStepCertifier(const RobotModel& robot, const Scene& scene, const ExperimentConfig& config);
  /// The same with a robot and a scene that are prepared already, each half-step with the pendulum
  /// of its own crouch.
  HalfStepCertifier(const MarginEvaluator& evaluator, const CertificationOptions& options);
  /// Whether it is proved; false as well when it is undecided.
  bool Certifies(const HalfStep& half_step, const Foothold& X_WS) const;

 private:
  MarginEvaluator evaluator_;
  CertifiedFeasibility feasibility_;
  std::shared_ptr<const MotionModel> model_;  // null: by the half-step's crouch
};

/// The half-steps of the config's grid that are certified, down and up, on an empty floor. Empty
/// when `progress` returns false.
StepSet CertifiedHalfSteps(const RobotModel& robot, const ExperimentConfig& config,
                           const std::function<bool(double)>& progress = {});

/// The same of half-steps like `prototype`, with the config's pendulum, whatever their crouch.
StepSet CertifiedHalfSteps(const RobotModel& robot, const ExperimentConfig& config,
                           const HalfStep& prototype,
                           const std::function<bool(double)>& progress = {});

/// The same on the levels of a ground: also half-steps to what is higher or lower by a difference
/// of its levels. Each is proved over a floor at the lower of its two footsteps, and its sole keeps
/// `floor` above its own footstep while it moves horizontally. Throws InputError when there are too
/// many differences.
StepSet CertifiedHalfStepsOn(const Ground& ground, const RobotModel& robot,
                             const ExperimentConfig& config,
                             const std::function<bool(double)>& progress = {});

}  // namespace halfstep
