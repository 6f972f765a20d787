#pragma once

#include <algorithm>

#include "wpg/motion/smoothstep.h"

namespace halfstep {

/// A C² step from 0 to 1 on a window [begin, end] of σ, with zero first and second derivatives at
/// both ends. Its speed rises for the fraction r = `ramp` of the window, is constant, and falls for
/// the same fraction. With x = (σ − begin)/(end − begin) and the Smoothstep S,
///
///     a·S(x/2r) on [0, r],   ½ + v·(x − ½) on [r, 1 − r],   1 − a·S((1 − x)/2r) on [1 − r, 1],
///     a = 16r/(15 − 14r),    v = 15/(15 − 14r).
///
/// Its greatest speed is v/(end − begin); that of S, which it is for r = ½, has 15/8 in place of v.
/// Antisymmetric, as S is. Source: wpg/README.md, "Half-step".
struct RampedStep {
  double begin = 0.0;  ///< of the window ∈ [0, 1)
  double end = 1.0;    ///< > begin
  double ramp = 0.5;   ///< ∈ (0, ½]

  /// Value and derivatives at σ.
  UnitJet At(double sigma) const {
    if (ramp == 0.5) return Rise().At(sigma);
    if (sigma <= steady_begin()) return Scaled(Rise().At(sigma));
    if (sigma < steady_end()) {
      const double speed = 15.0 / ((15.0 - 14.0 * ramp) * (end - begin));
      return {.value = 0.5 + speed * (sigma - 0.5 * (begin + end)), .s = speed};
    }
    UnitJet jet = Scaled(Fall().At(sigma));
    jet.value += 1.0 - scale();  // 1 − a·(1 − S)
    return jet;
  }

  /// How At is computed: as Smoothstep::Accuracy, of windows as wide as both ramps, whose ends are
  /// off by twice as much.
  UnitAccuracy Accuracy() const {
    if (ramp == 0.5) return Rise().Accuracy();
    UnitAccuracy accuracy = Rise().Accuracy();
    for (double* error : {&accuracy.error.value, &accuracy.error.s, &accuracy.error.ss}) {
      *error *= 2.0;
    }
    return accuracy;
  }

  /// Derivatives of At(σ) with respect to `begin` and to `end`: only value, s and ss.
  UnitJet ByBegin(double sigma) const {
    return At(sigma).Moved((sigma - end) / (end - begin), 1.0 / (end - begin));
  }
  UnitJet ByEnd(double sigma) const {  ///< see ByBegin
    return At(sigma).Moved((begin - sigma) / (end - begin), -1.0 / (end - begin));
  }
  /// The derivative of At(σ) with respect to `ramp`, towards 0 for a ramp of ½: only value, s, ss.
  UnitJet ByRamp(double sigma) const {
    if (sigma <= begin || sigma >= end) return {};
    const double q = 15.0 - 14.0 * ramp, middle = 0.5 * (begin + end);
    if (sigma > begin + ramp * (end - begin) && sigma < end - ramp * (end - begin)) {
      const double faster = 210.0 / (q * q * (end - begin));  // dv/dr over the window
      return {.value = faster * (sigma - middle), .s = faster};
    }
    UnitJet f = At(sigma);
    const bool rises = sigma < middle;
    UnitJet moved = f.Moved((rises ? begin - sigma : end - sigma) / ramp, -1.0 / ramp);
    if (!rises) f.value -= 1.0;
    const double higher = 15.0 / (ramp * q);  // a'/a
    moved.value += higher * f.value;
    moved.s += higher * f.s;
    moved.ss += higher * f.ss;
    return moved;
  }

  /// sup |second derivative| on [from, to]: exact.
  double SecondBound(double from, double to) const {
    if (ramp == 0.5) return Rise().SecondBound(from, to);
    double bound = 0.0;
    if (from < steady_begin()) bound = Rise().SecondBound(from, std::min(to, steady_begin()));
    if (to > steady_end()) {
      bound = std::max(bound, Fall().SecondBound(std::max(from, steady_end()), to));
    }
    return scale() * bound;
  }

  /// The values of the third derivative on [from, to]: exact, with 0 where that reaches out of the
  /// ramps.
  Range ThirdRange(double from, double to) const {
    if (ramp == 0.5) return Rise().ThirdRange(from, to);
    const double a = scale();
    const auto scaled = [a](const Range& x) { return Range{a * x.center, a * x.radius}; };
    if (to <= steady_begin()) return scaled(Rise().ThirdRange(from, to));
    if (from >= steady_end()) return scaled(Fall().ThirdRange(from, to));
    double low = 0.0, high = 0.0;  // of the middle
    const auto include = [&](const Range& x) {
      low = std::min(low, x.center - x.radius);
      high = std::max(high, x.center + x.radius);
    };
    if (from < steady_begin()) include(Rise().ThirdRange(from, steady_begin()));
    if (to > steady_end()) include(Fall().ThirdRange(steady_end(), to));
    return Range::Between(a * low, a * high);
  }

  /// The speed is constant between these; when it never is, they are the window's ends.
  double steady_begin() const { return ramp == 0.5 ? begin : begin + ramp * (end - begin); }
  /// The end of that stretch.
  double steady_end() const { return ramp == 0.5 ? end : end - ramp * (end - begin); }

 private:
  double scale() const { return 16.0 * ramp / (15.0 - 14.0 * ramp); }
  // The Smoothsteps whose first and second halves the ramps are; both are S for a ramp of ½.
  Smoothstep Rise() const { return {begin, begin + 2.0 * ramp * (end - begin)}; }
  Smoothstep Fall() const { return {end - 2.0 * ramp * (end - begin), end}; }
  UnitJet Scaled(UnitJet f) const {
    const double a = scale();
    return {.value = a * f.value, .s = a * f.s, .ss = a * f.ss, .sss = a * f.sss};
  }
};

}  // namespace halfstep
