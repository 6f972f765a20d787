#pragma once

#include "smoothing/proof/certified_feasibility.h"
#include "tests/smoothing/test_walks.h"
#include "tests/wpg/one_step.h"
#include "wpg/motion/lipm.h"

namespace halfstep {

/// Nothing is demanded but of one family.
inline MarginLimits Only(MarginFamily family, double demanded) {
  MarginLimits limits;
  limits.demanded.fill(-100.0);
  // It is −∞ where the ZMP is outside the support polygon.
  limits.demanded_of(MarginFamily::kFriction) = kNotDemanded;
  // It is −∞ where a sole stands on no level.
  limits.demanded_of(MarginFamily::kFoothold) = kNotDemanded;
  limits.demanded_of(family) = demanded;
  return limits;
}

/// Both feet 0.2 m ahead.
inline HalfStepSequence TwoSteps(const RobotModel& robot) {
  const double y = 0.5 * robot.standing_width;
  return MakeSequence(
      StandingFeet(robot),
      {{.side = Side::kRight, .X_WF = Foothold::Level({0.2, -y, 0}), .duration = 1.2},
       {.side = Side::kLeft, .X_WF = Foothold::Level({0.2, y, 0}), .duration = 1.2}},
      0.24, {}, std::make_shared<Lipm>(robot.com_height));
}

/// The proof of a walk, and its rows.
inline Feasibility Certify(const RobotModel& robot, const Scene& scene, const MarginLimits& limits,
                           const SuperposedWalk& walk, Certificate* certificate) {
  const MarginEvaluator evaluator(robot, scene, limits);
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  return CertifiedFeasibility(evaluator, {}).Certify(walk, &scratch, certificate);
}

}  // namespace halfstep
