#pragma once

#include <optional>

#include "smoothing/walk/splice.h"

namespace halfstep {

/// A walk in execution without most of what is past, so that what it costs to hold it and to think
/// about it does not grow with what was walked. In place of the past stands a step that is over,
/// one more for each hour, and a rest until half-steps begin as they do: at the same times, to the
/// bit. So the motion is the same from then on.
struct RecentPart {
  WalkPlan plan;  ///< of it
  int first = 0;  ///< half-step of the walk that its 0 is; even

  /// None where little is past. `begun`: the latest half-step that has begun.
  static std::optional<RecentPart> Of(const WalkPlan& plan, const SuperposedWalk& walk, int begun);
};

}  // namespace halfstep
