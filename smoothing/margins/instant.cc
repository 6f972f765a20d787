#include "smoothing/margins/instant.h"

namespace halfstep {

Instant::Instant(const MarginPlace& place, const MarginLimits& limits, const SuperposedWalk& walk,
                 const LocalTime& at, MarginScratch* scratch)
    : place_(place),
      limits_(limits),
      walk_(walk),
      at_(at),
      scratch_(*scratch),
      jet_(walk.At(at)),
      step_(walk.StepInAir(at)) {}

Instant::Instant(const MarginPlace& place, const MarginLimits& limits, const SuperposedWalk& walk,
                 const LocalTime& at, const WalkJet& jet, const Posture& posture,
                 MarginScratch* scratch)
    : place_(place),
      limits_(limits),
      walk_(walk),
      at_(at),
      scratch_(*scratch),
      jet_(jet),
      step_(walk.StepInAir(at)),
      posture_(&posture),
      speeds_tried_(true),
      regular_(true) {}

const Posture& Instant::posture() {
  if (posture_ == nullptr) {
    own_ = SolvePosture(robot(), jet_.value);
    posture_ = &own_;
  }
  return *posture_;
}

bool Instant::regular() {
  if (!speeds_tried_) {
    speeds_tried_ = true;
    regular_ = reachable() && SolveJointSpeeds(robot(), jet_, &own_);
  }
  return regular_;
}

}  // namespace halfstep
