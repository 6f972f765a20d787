#include "experiments/run/isolated_step.h"

#include "smoothing/walk/superposed_walk.h"
#include "wpg/motion/half_step_sequence.h"
#include "wpg/nth.h"

namespace halfstep {

bool AcceptsHalfStep(const FeasibilityTest& test, const HalfStep& half_step, const Foothold& X_WS,
                     const std::shared_ptr<const MotionModel>& model,
                     MarginEvaluator::Scratch* scratch) {
  std::array<Foothold, 2> start;
  Nth(start, Index(half_step.support)) = X_WS;
  Nth(start, Index(half_step.swing())) = X_WS * half_step.X_SF;
  const Footstep footstep{.side = half_step.swing(),
                          .X_WF = X_WS * half_step.X_SF,
                          .via_height = half_step.via_height,
                          .duration = half_step.duration};
  HalfStepSequence sequence =
      MakeSequence(start, {footstep}, half_step.via_lateral, half_step.shape, model);
  for (PlacedHalfStep& placed : sequence.half_steps) {
    placed.half_step.standing_crouch = half_step.standing_crouch;
  }
  const SuperposedWalk walk(sequence, PlannedMotion(sequence));
  const int i = half_step.kind == HalfStepKind::kUp ? 0 : 1;
  return test.Check(walk, {walk.start_of(i), walk.end_of(i)}, scratch).verdict ==
         Verdict::kFeasible;
}

}  // namespace halfstep
