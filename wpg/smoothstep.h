#pragma once

#include "wpg/profile_jet.h"

namespace halfstep {

/// The C² step S(x) = 10x³ − 15x⁴ + 6x⁵ on a window [begin, end] of σ: 0 before, 1 after, with zero
/// first and second derivatives at both ends. Antisymmetric: S(x) + S(1 − x) = 1.
struct Smoothstep {
  double begin = 0.0;
  double end = 1.0;  ///< > begin

  UnitJet At(double sigma) const {
    if (sigma <= begin) return {};
    if (sigma >= end) return {.value = 1.0};
    const double r = 1.0 / (end - begin);
    const double x = (sigma - begin) * r;
    const double y = 1.0 - x;
    // On the upper half by antisymmetry, so that S meets 1 as accurately as it leaves 0.
    const double u = x < 0.5 ? x : y;
    const double low = u * u * u * (10.0 + u * (-15.0 + 6.0 * u));
    return {.value = x < 0.5 ? low : 1.0 - low,
            .s = 30.0 * x * x * y * y * r,
            .ss = 60.0 * x * y * (1.0 - 2.0 * x) * r * r,
            .sss = 60.0 * (1.0 - 6.0 * x * y) * r * r * r};
  }
};

}  // namespace halfstep
