#pragma once

#include "smoothing/walk/splice.h"

namespace halfstep {

/// The end of a walk. What is before it is that of the walk which it takes over from.
struct WalkTail {
  int first = 0;         ///< of the walk's half-steps the one that it begins with; even
  double begin = 0.0;    ///< when that one begins [s]
  double overlap = 0.0;  ///< of that one with the one before it [s]; 0: there is none
  WalkPlan plan;         ///< from there on; its half-step 0 is `first`

  /// Half-steps of the whole walk.
  int size() const { return first + plan.sequence.size(); }
  double end() const;  ///< of the whole walk, added up as SuperposedWalk does [s]
};

/// The end of a walk from half-step `first` on. Precondition: it is even, and there is one.
WalkTail TailOf(const WalkPlan& plan, const SuperposedWalk& walk, int first);

/// Puts an end in place of what the walk has from there on. Precondition: the walk reaches up to
/// there (std::logic_error).
void Join(const WalkTail& tail, WalkPlan* walk);

}  // namespace halfstep
