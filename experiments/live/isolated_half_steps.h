#pragma once

#include <optional>

#include "planner/search/half_step_query.h"
#include "planner/search/step_set.h"
#include "smoothing/walk/superposed_walk.h"

namespace halfstep {

/// An element of a half-step set, and the sole that supports its down half-step.
struct SetElement {
  int index = 0;               ///< in the set
  Side support = Side::kLeft;  ///< of the down half-step
};

/// The element whose down or up half-step this is; none when it is of no element, or lasts longer
/// or goes higher than the set's.
std::optional<SetElement> ElementOf(const HalfStep& half_step, const StepSet& set);

/// Whether the walk cut after half-step j is an isolated half-step of the set from that half-step's
/// beginning on: none before it is still under way then. So it keeps whatever the set was proved to
/// keep wherever it stands.
bool EndsWithSetElement(const SuperposedWalk& walk, int j, const StepSet& set);

/// Whether no other half-step of the walk is under way together with half-step j, this one is a
/// half-step of the set, and its swept volume is free: then it keeps the clearance of the volumes
/// at all times. `query` is of volumes of the set. No-step areas
/// that soles already stand on do not count.
bool IsolatedAndFree(const SuperposedWalk& walk, int j, const StepSet& set,
                     const HalfStepQuery& query);

}  // namespace halfstep
