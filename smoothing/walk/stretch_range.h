#pragma once

#include <limits>

namespace halfstep {

/// Some stretches [t_k, t_{k+1}] of a walk: those of the half-steps first … last.
struct StretchRange {
  int first = 0;                               ///< half-step, from 0
  int last = std::numeric_limits<int>::max();  ///< half-step, included

  /// Whether the stretch of that half-step is one of them.
  bool contains(int half_step) const { return first <= half_step && half_step <= last; }
};

}  // namespace halfstep
