#pragma once

#include <array>
#include <optional>

#include "experiments/live/proposal.h"
#include "experiments/live/safety.h"
#include "experiments/run/planning.h"

namespace halfstep {

/// Whether a half-step begins when all those before it have ended, as the first one does.
bool BeginsAtRest(const SuperposedWalk& walk, int half_step);

/// Proofs for one half-step of a robot that came to rest nearer to obstacles than demanded. Every
/// half-step from there begins by violating the demand, so from these obstacles it keeps less:
/// the margin that there is when it begins, less 1 mm, and at least 0, so that none is touched as
/// long as it keeps to r and v. From all other obstacles it keeps what is demanded.
/// Source: experiments/episodes.md, "A half-step that draws away".
class NearRest {
 public:
  /// For half-step `half_step` of a walk among the obstacles of `among`. None when no obstacle is
  /// nearer than demanded where the half-step begins, or when one may be touched there. The robot
  /// rests when it begins, at `begin` [s].
  static std::optional<NearRest> At(const SafetyCheck& among, const ExperimentConfig& config,
                                    const SuperposedWalk& walk, int half_step, double begin);

  /// For the half-step that may follow the stop of a situation or the end of its walk, or that
  /// followed one and is under way. `walk` goes on from there.
  static std::optional<NearRest> Of(const Situation& situation, const SuperposedWalk& walk,
                                    const SafetyCheck& among, const ExperimentConfig& config);

  /// For the first half-step of any walk from the soles `start`, at t = 0. `like`: a half-step of
  /// the robot.
  static std::optional<NearRest> AtStart(const SafetyCheck& among, const ExperimentConfig& config,
                                         const std::array<Foothold, 2>& start,
                                         const HalfStep& like);

  int half_step() const { return half_step_; }  ///< for which the proofs are
  double margin() const { return margin_; }     ///< of the nearest obstacle when it begins [m]
  const SafetyCheck& safety() const { return safety_; }              ///< proofs of the walk
  const HalfStepCertifier& certifier() const { return certifier_; }  ///< of the half-step alone

 private:
  NearRest(int half_step, double margin, SafetyCheck safety, const ExperimentConfig& config)
      : half_step_(half_step),
        margin_(margin),
        safety_(std::move(safety)),
        certifier_(safety_.evaluator(), config.smoothing.certification) {}

  int half_step_;
  double margin_;
  SafetyCheck safety_;
  HalfStepCertifier certifier_;
};

}  // namespace halfstep
