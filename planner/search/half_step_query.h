#pragma once

#include "wpg/geometry/foothold.h"
#include "wpg/geometry/side.h"

namespace halfstep {

/// Answers whether a half-step of a StepSet, placed in the world, keeps clear of a scene for
/// all t. "Free" is proved; anything in doubt is not free. Const and thread-safe.
class HalfStepQuery {
 public:
  virtual ~HalfStepQuery() = default;

  /// Whether the down half-step of element i on `support`, whose sole stands at X_WS, is free; the
  /// sole that lands keeps off no-step areas as well.
  virtual bool DownIsFree(int i, Side support, const Foothold& X_WS) const = 0;
  /// Whether the up half-step that follows, on the foot that has landed, is free. X_WS is still the
  /// pose of the sole that supported before, as for DownIsFree.
  virtual bool UpIsFree(int i, Side support, const Foothold& X_WS) const = 0;
  /// Whether the ground bears a sole at X_WF, at that height; DownIsFree asks it of the sole that
  /// lands. Where it is asked first, what lands on nothing costs little.
  virtual bool Bears(const Foothold&) const { return true; }
};

}  // namespace halfstep
