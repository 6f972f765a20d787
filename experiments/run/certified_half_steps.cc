#include "experiments/run/certified_half_steps.h"

#include <algorithm>
#include <map>
#include <memory>
#include <vector>

#include "experiments/run/isolated_step.h"
#include "smoothing/margins/demandable.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/motion/half_step_tracks.h"
#include "wpg/robot/robot_measures.h"

namespace halfstep {
namespace {

// Half-steps between two levels.
class LevelCertifier {
 public:
  LevelCertifier(const RobotModel& robot, const ExperimentConfig& config)
      : robot_(robot),
        config_(config),
        model_(MotionModelOf(robot, PrototypeOf(config).shape)),
        floor_(Demandable(config.smoothing.limits, robot).demanded_of(MarginFamily::kFloor)) {}

  bool Certifies(const HalfStep& half_step) {
    if (!KeepsOffItsFootstep(half_step)) return false;
    const double lower = std::min(0.0, half_step.X_SF.height);
    auto over = over_.find(lower);
    if (over == over_.end()) {
      Scene scene;
      scene.ground = std::make_shared<const FlatGround>(lower);
      over = over_.try_emplace(lower, robot_, scene, config_).first;
    }
    return over->second.Certifies(half_step, {});
  }

 private:
  // What a floor at the lower footstep does not say. The sole rises or sinks all the time, so it is
  // lowest where its horizontal motion meets the footstep.
  bool KeepsOffItsFootstep(const HalfStep& half_step) const {
    constexpr double kRounding = 1e-12;
    const HalfStepTracks tracks(half_step, *model_);
    const double lowest =
        half_step.kind == HalfStepKind::kUp ? tracks.horizontal_begin() : tracks.horizontal_end();
    const double z = tracks.At(lowest).value[FootIndex(half_step.swing()) + 2];
    return z - half_step.X_SF.height >= floor_ + kRounding;
  }

  const RobotModel& robot_;
  const ExperimentConfig& config_;
  std::shared_ptr<const MotionModel> model_;
  double floor_;                              // demanded [m]
  std::map<double, HalfStepCertifier> over_;  // by the height of the floor
};

// Differences of height by which a foot may be tried to land higher or lower.
std::vector<double> RisesOn(const Ground& ground, const RobotModel& robot) {
  constexpr double kOfLeg = 0.4;  // no humanoid's step is higher
  constexpr size_t kMost = 16;    // each has to be certified and baked
  std::vector<double> heights;
  for (const GroundLevel& level : ground.Levels()) heights.push_back(level.height);
  const double most = kOfLeg * LegLengthOf(robot);
  std::vector<double> rises = RisesBetween(heights, most);
  if (rises.size() <= kMost) return rises;
  throw InputError({Formatted(
      "scene: its levels have %zu differences of height within %.2g m, each of which takes "
      "half-steps of its own (valid: at most %zu, by fewer or equal heights; or footsteps in place "
      "of a goal)",
      rises.size(), most, kMost)});
}

}  // namespace

HalfStepCertifier::HalfStepCertifier(const RobotModel& robot, const Scene& scene,
                                     const ExperimentConfig& config)
    : HalfStepCertifier(MarginEvaluator(robot, scene, config.smoothing.limits),
                        config.smoothing.certification) {
  model_ = MotionModelOf(robot, ShapeOf(config.half_step));
}

HalfStepCertifier::HalfStepCertifier(const MarginEvaluator& evaluator,
                                     const CertificationOptions& options)
    : evaluator_(evaluator), feasibility_(evaluator, options) {}

bool HalfStepCertifier::Certifies(const HalfStep& half_step, const Foothold& X_WS) const {
  MarginEvaluator::Scratch scratch = evaluator_.MakeScratch();
  return AcceptsHalfStep(feasibility_, half_step, X_WS,
                         model_ ? model_ : MotionModelOf(evaluator_.robot(), half_step.shape),
                         &scratch);
}

StepSet CertifiedHalfSteps(const RobotModel& robot, const ExperimentConfig& config,
                           const std::function<bool(double)>& progress) {
  return CertifiedHalfSteps(robot, config, PrototypeOf(config), progress);
}

StepSet CertifiedHalfSteps(const RobotModel& robot, const ExperimentConfig& config,
                           const HalfStep& prototype, const std::function<bool(double)>& progress) {
  const HalfStepCertifier certifier(robot, Scene{}, config);
  return MakeStepSet(
      config.step_set, prototype,
      [&](const HalfStep& half_step) {
        return certifier.Certifies(half_step, {}) &&
               (robot.legs_are_mirrored || certifier.Certifies(half_step.Mirrored(), {}));
      },
      progress);
}

StepSet CertifiedHalfStepsOn(const Ground& ground, const RobotModel& robot,
                             const ExperimentConfig& config,
                             const std::function<bool(double)>& progress) {
  LevelCertifier certifier(robot, config);
  return MakeStepSet(
      config.step_set, PrototypeOf(config), RisesOn(ground, robot),
      [&](const HalfStep& half_step) {
        return certifier.Certifies(half_step) &&
               (robot.legs_are_mirrored || certifier.Certifies(half_step.Mirrored()));
      },
      progress);
}

}  // namespace halfstep
