#include "wpg/motion/half_step_sequence.h"

#include <algorithm>
#include <utility>

#include "wpg/check.h"
#include "wpg/nth.h"

namespace halfstep {

HalfStepSequence MakeSequence(const std::array<Foothold, 2>& start,
                              const std::vector<Footstep>& footsteps, double via_lateral,
                              const HalfStepShape& shape,
                              std::shared_ptr<const MotionModel> model) {
  HALFSTEP_CHECK(!footsteps.empty(), "no footsteps");
  HALFSTEP_CHECK(model != nullptr, "no model");
  HalfStepSequence sequence{.start = start, .half_steps = {}, .model = std::move(model)};
  std::array<Foothold, 2> feet = start;
  double crouch = shape.crouch;
  for (const Footstep& footstep : footsteps) {
    const Side swing = footstep.side;
    const Foothold X_WS = Nth(feet, Index(Opposite(swing)));
    Foothold& foot = Nth(feet, Index(swing));
    HalfStep half_step{.support = Opposite(swing),
                       .kind = HalfStepKind::kUp,
                       .X_SF = X_WS.Inverse() * foot,
                       .duration = footstep.duration,
                       .via_height = footstep.via_height,
                       .via_lateral = via_lateral,
                       .shape = shape};
    half_step.shape.crouch = footstep.crouch.value_or(shape.crouch);
    if (half_step.shape.crouch != crouch) half_step.standing_crouch = crouch;
    sequence.half_steps.push_back({half_step, X_WS, footstep.rest});
    crouch = half_step.shape.crouch;
    half_step.standing_crouch.reset();
    foot = footstep.X_WF;
    half_step.kind = HalfStepKind::kDown;
    half_step.X_SF = X_WS.Inverse() * foot;
    sequence.half_steps.push_back({half_step, X_WS, footstep.rest_on_one_foot});
  }
  return sequence;
}

bool ChangesCrouch(const HalfStepSequence& sequence) {
  return std::ranges::any_of(sequence.half_steps, [](const PlacedHalfStep& placed) {
    return placed.half_step.crouch_on_floor() != placed.half_step.shape.crouch;
  });
}

HalfStepSequence Mirrored(const HalfStepSequence& sequence) {
  HalfStepSequence mirrored = sequence;
  mirrored.start = {sequence.start[1].Mirrored(), sequence.start[0].Mirrored()};
  for (PlacedHalfStep& placed : mirrored.half_steps) {
    placed = {placed.half_step.Mirrored(), placed.X_WS.Mirrored(), placed.rest};
  }
  return mirrored;
}

HalfStepSequence Moved(const Pose2& X_VW, const HalfStepSequence& sequence) {
  HalfStepSequence moved = sequence;
  for (Foothold& sole : moved.start) sole = Foothold::Level(X_VW) * sole;
  for (PlacedHalfStep& placed : moved.half_steps) placed.X_WS = Foothold::Level(X_VW) * placed.X_WS;
  return moved;
}

}  // namespace halfstep
