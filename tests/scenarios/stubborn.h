#pragma once

#include <algorithm>

#include "smoothing/proof/certified_feasibility.h"

namespace halfstep {

/// The same test, but it refuses walks in which one half-step, known by its place, does not last as
/// long as planned.
class Stubborn : public CertifiedFeasibility {
 public:
  /// Only of walks of at least so many half-steps.
  Stubborn(const CertifiedFeasibility& test, const PlacedHalfStep& half_step, int least = 1)
      : CertifiedFeasibility(test), half_step_(half_step), least_(least) {}
  Feasibility Check(const SuperposedWalk& walk, const TimeSpan& span,
                    MarginEvaluator::Scratch* scratch) const override {
    for (int k = 0; k < walk.num_half_steps() && walk.num_half_steps() >= least_; ++k) {
      const bool it = walk.X_WS(k).Planar().position() == half_step_.X_WS.Planar().position() &&
                      walk.half_step(k).kind == half_step_.half_step.kind;
      const bool asked = walk.end_of(k) > span.begin && walk.start_of(k) < span.end;
      if (!it || !asked ||
          walk.parameters().durations[static_cast<size_t>(k)] == half_step_.half_step.duration) {
        continue;
      }
      Margin witness{.family = MarginFamily::kZmp, .value = -1.0};
      witness.t = std::max(span.begin, walk.start_of(k));
      witness.at = walk.Locate(witness.t);
      return {Verdict::kViolated, Evidence::kCertified, witness};
    }
    return CertifiedFeasibility::Check(walk, span, scratch);
  }

 private:
  PlacedHalfStep half_step_;
  int least_;
};

}  // namespace halfstep
