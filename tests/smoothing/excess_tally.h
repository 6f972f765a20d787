#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

#include "wpg/motion/vector_ball.h"

namespace halfstep {

/// How far truths are beyond their bounds, relative to what rounding may make of them, and the
/// nearest to a bound.
struct ExcessTally {
  struct Entry {
    double excess = 0.0, nearest = 0.0;
    long compared = 0;
  };
  std::map<std::string_view, Entry> parts;

  /// `size`: of what truth is a difference of, with all that is multiplied.
  void Compare(std::string_view what, double truth, double bound, double size) {
    if (!std::isfinite(bound)) return;
    const double rounding = 1e-12 * (size + 1.0);
    Entry& part = parts[what];
    ++part.compared;
    part.excess = std::max(part.excess, (truth - bound) / rounding);
    if (truth > 1e3 * rounding) part.nearest = std::max(part.nearest, truth / bound);
  }
  /// A vector within a ball, or within one of rates times `time`.
  void Compare(std::string_view what, const Eigen::Vector3d& truth, const VectorBall& ball,
               double size, double time = 1.0) {
    Compare(what, (truth - time * ball.center).norm(), std::abs(time) * ball.radius, size);
  }
};

}  // namespace halfstep
