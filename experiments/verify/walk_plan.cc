#include "experiments/verify/walk_plan.h"

#include <algorithm>

#include "wpg/check.h"
#include "wpg/nth.h"

namespace halfstep::verify {

double StartCrouch(const WalkPlan& plan) {
  if (plan.half_steps.empty()) return 0.0;
  const HalfStep& first = plan.half_steps.front().half_step;
  return first.standing_crouch.value_or(first.crouch);
}

bool ChangesCrouch(const WalkPlan& plan) {
  return std::ranges::any_of(plan.half_steps, [start = StartCrouch(plan)](const auto& placed) {
    return placed.half_step.crouch != start;
  });
}

WalkPlan PlanOf(const std::array<Foothold, 2>& start, const std::vector<PlannedFootstep>& footsteps,
                const HalfStep& common) {
  WalkPlan plan{.start = start, .half_steps = {}};
  std::array<Foothold, 2> soles = start;
  double standing = common.crouch;  // the waist stands so far below
  for (const PlannedFootstep& footstep : footsteps) {
    HalfStep half_step = common;
    half_step.support = Opposite(footstep.side);
    half_step.duration = footstep.duration;
    half_step.via_height = footstep.via_height;
    half_step.crouch = footstep.crouch.value_or(common.crouch);
    const Foothold X_WS = Nth(soles, Index(half_step.support));
    for (const bool up : {true, false}) {
      if (!up) Nth(soles, Index(footstep.side)) = footstep.X_WF;
      half_step.up = up;
      half_step.standing_crouch = standing;
      standing = half_step.crouch;
      half_step.X_SF = X_WS.Inverse() * Nth(soles, Index(footstep.side));
      plan.half_steps.push_back({half_step, X_WS, up ? footstep.rest : footstep.rest_on_one});
    }
  }
  return plan;
}

WalkPlan Moved(const WalkPlan& plan, const std::vector<Pose2>& moves) {
  HALFSTEP_CHECK(moves.size() == static_cast<size_t>(plan.num_steps()),
                 moves.size() << " moves of " << plan.num_steps() << " footsteps");
  WalkPlan moved = plan;
  std::array<Foothold, 2> soles = plan.start;
  for (size_t j = 0; j < moves.size(); ++j) {
    PlacedHalfStep &up = moved.half_steps[2 * j], &down = moved.half_steps[2 * j + 1];
    const Foothold planned = down.X_WS * down.half_step.X_SF;
    Foothold& sole = Nth(soles, Index(up.half_step.swing()));
    up.X_WS = down.X_WS = Nth(soles, Index(up.half_step.support));
    up.half_step.X_SF = up.X_WS.Inverse() * sole;
    sole = planned * Foothold::Level(moves[j]);
    down.half_step.X_SF = down.X_WS.Inverse() * sole;
  }
  return moved;
}

}  // namespace halfstep::verify
