#pragma once

#include <utility>

#include "smoothing/methods/accepted_walk.h"

namespace halfstep {

/// For methods of this library only: not installed, so that a method of a user's own has no way
/// around SmoothingMonitor::Propose. Who calls it answers for a proof in parts: stretch by stretch
/// (StretchProofs), of a window that was pasted into a proved walk (WalkWindow), or of the stretch
/// that one overlap changes. What a run keeps is judged once more, as a whole, when it is written.
struct AcceptedInParts {
  /// The walk of `parameters`, of which every part was accepted by the test of the problem.
  static AcceptedWalk Walk(HomotopyParameters parameters) {
    return AcceptedWalk(std::move(parameters));
  }
};

}  // namespace halfstep
