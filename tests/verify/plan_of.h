#pragma once

#include "experiments/verify/walk_plan.h"
#include "wpg/motion/half_step_sequence.h"

namespace halfstep::verify {

/// The program's plan in the words of verify.
inline WalkPlan PlanOf(const HalfStepSequence& sequence) {
  WalkPlan plan{.start = sequence.start, .half_steps = {}};
  for (const auto& [of, X_WS, rest] : sequence.half_steps) {
    plan.half_steps.push_back({{.up = of.kind == HalfStepKind::kUp,
                                .support = of.support,
                                .X_SF = of.X_SF,
                                .duration = of.duration,
                                .via_height = of.via_height,
                                .support_point = of.shape.support_point,
                                .form = {.via_lateral = of.via_lateral,
                                         .foot_ramp = of.shape.foot_ramp,
                                         .foot_delay = of.shape.foot_delay,
                                         .lift_share = of.shape.lift_share,
                                         .via_along = of.via_along,
                                         .zmp_shift = of.shape.shift,
                                         .zmp_bump_ramp = of.shape.bump_ramp,
                                         .rise_begin = of.shape.rise_begin,
                                         .rise_end = of.shape.rise_end},
                                .crouch = of.shape.crouch},
                               X_WS,
                               rest});
  }
  return plan;
}

}  // namespace halfstep::verify
