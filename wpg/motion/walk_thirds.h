#pragma once

#include "halfstep/wpg/motion/vector_ball.h"
#include "halfstep/wpg/motion/walk_state.h"

namespace halfstep {

/// Third time derivatives of all quantities but the ZMP over an interval: each lies within `radius`
/// of `center` at all times where it exists [unit/s³]. They jump where a profile's pieces meet.
struct WalkThirds {
  WalkState center = WalkState::Zero();
  WalkState radius = WalkState::Zero();

  Range of(int quantity) const { return {center[quantity], radius[quantity]}; }
};

}  // namespace halfstep
