#pragma once

#include "wpg/geometry/foothold.h"

namespace halfstep {

/// A foot that stands, and where the other one lands beyond what is in question: on another level,
/// or behind an obstacle.
struct Crossing {
  Side support;         ///< the foot that stands
  Foothold X_WS, X_WF;  ///< where it stands, and where the other one lands
  int kind = 0;         ///< crossings of one kind are judged together
  double rise() const { return X_WF.height - X_WS.height; }  ///< [m], below 0 down
};

}  // namespace halfstep
