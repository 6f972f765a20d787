#include "experiments/live/isolated_half_steps.h"

#include <cmath>

#include "wpg/nth.h"

namespace halfstep {
namespace {

// Whether a place differs from that of an element by no more than the rounding of placing it in the
// world.
bool Same(const Foothold& a, const Foothold& b) {
  constexpr double kRounding = 1e-12;  // [m], [rad]
  return std::abs(a.x - b.x) <= kRounding && std::abs(a.y - b.y) <= kRounding &&
         std::abs(a.yaw - b.yaw) <= kRounding && a.height == b.height;
}

// Whether half-step j is executed from rest to rest.
bool IsIsolated(const SuperposedWalk& walk, int j) {
  const std::vector<double>& overlaps = walk.parameters().overlaps;
  return (j == 0 || Nth(overlaps, j - 1) <= 0.0) &&
         (j == std::ssize(overlaps) || Nth(overlaps, j) <= 0.0);
}

}  // namespace

std::optional<SetElement> ElementOf(const HalfStep& half_step, const StepSet& set) {
  const bool down = half_step.kind == HalfStepKind::kDown;
  // An element is told by the sole that supports its down half-step.
  const Side support = down ? half_step.support : half_step.swing();
  const Foothold placement = down ? half_step.X_SF : half_step.X_SF.Inverse();
  for (int i = 0; i < set.size(); ++i) {
    if (!Same(placement, set.Placement(i, support))) continue;
    HalfStep like = down ? set.Down(i, support) : set.Up(i, support);
    like.X_SF = half_step.X_SF;
    if (like != half_step) return std::nullopt;
    return SetElement{i, support};
  }
  return std::nullopt;
}

bool EndsWithSetElement(const SuperposedWalk& walk, int j, const StepSet& set) {
  // Ends are in order: when the one before has ended, all have.
  return (j == 0 || walk.end_of(j - 1) <= walk.start_of(j)) &&
         ElementOf(walk.half_step(j), set).has_value();
}

bool IsolatedAndFree(const SuperposedWalk& walk, int j, const StepSet& set,
                     const HalfStepQuery& query) {
  if (!IsIsolated(walk, j)) return false;
  const HalfStep& half_step = walk.half_step(j);
  const std::optional<SetElement> element = ElementOf(half_step, set);
  if (!element) return false;
  return half_step.kind == HalfStepKind::kDown
             ? query.DownIsFree(element->index, element->support, walk.X_WS(j))
             : query.UpIsFree(element->index, element->support, walk.X_WS(j) * half_step.X_SF);
}

}  // namespace halfstep
