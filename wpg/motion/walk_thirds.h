#pragma once

#include "wpg/motion/vector_ball.h"
#include "wpg/motion/walk_state.h"

namespace halfstep {

/// Third time derivatives of all quantities but the ZMP over an interval: each lies within `radius`
/// of `center` at all times where it exists [unit/s³]. They jump where a profile's pieces meet.
struct WalkThirds {
  WalkState center = WalkState::Zero();  ///< by Quantity
  WalkState radius = WalkState::Zero();  ///< by Quantity, ≥ 0

  /// Of one Quantity, as a range.
  Range of(int quantity) const { return {center[quantity], radius[quantity]}; }
};

}  // namespace halfstep
