#pragma once

#include <algorithm>
#include <cmath>

#include "wpg/motion/profile_jet.h"
#include "wpg/motion/vector_ball.h"
#include "wpg/rounded.h"

namespace halfstep {

/// The C² step S(x) = 10x³ − 15x⁴ + 6x⁵ on a window [begin, end] of σ: 0 before, 1 after, with zero
/// first and second derivatives at both ends. Antisymmetric: S(x) + S(1 − x) = 1.
struct Smoothstep {
  double begin = 0.0;  ///< of the window ∈ [0, 1)
  double end = 1.0;    ///< > begin

  /// Value and derivatives at σ.
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

  /// How At is computed, where `begin` and `end` are off by 4 roundings: x then by 20 over the
  /// window's width, at most.
  UnitAccuracy Accuracy() const {
    const double r = 1.0 / (end - begin), e = kRoundoff * r;
    return {.error = {.value = 60.0 * e, .s = 160.0 * e * r, .ss = 1400.0 * e * r * r},
            .most = {.value = 1.0, .s = 1.875 * r, .ss = 5.78 * r * r, .sss = 60.0 * r * r * r}};
  }

  /// Derivatives of At(σ) with respect to `begin` and to `end`: only value, s and ss.
  UnitJet ByBegin(double sigma) const {
    return At(sigma).Moved((sigma - end) / (end - begin), 1.0 / (end - begin));
  }
  UnitJet ByEnd(double sigma) const {  ///< see ByBegin
    return At(sigma).Moved((begin - sigma) / (end - begin), -1.0 / (end - begin));
  }

  /// sup |S_σσ| on [from, to]: exact. S_σσ is extremal at x = ½ ± 1/√12, where it is ∓10/√3 /
  /// width².
  double SecondBound(double from, double to) const {
    const double r = 1.0 / (end - begin);
    const double a = std::clamp((from - begin) * r, 0.0, 1.0);
    const double b = std::clamp((to - begin) * r, 0.0, 1.0);
    constexpr double kLow = 0.21132486540518713, kHigh = 0.78867513459481287,
                     kPeak = 5.7735026918962582;
    const auto at = [](double x) { return std::abs(60.0 * x * (1.0 - x) * (1.0 - 2.0 * x)); };
    const bool peak = (a <= kLow && kLow <= b) || (a <= kHigh && kHigh <= b);
    return (peak ? kPeak : std::max(at(a), at(b))) * r * r;
  }

  /// The values of S_σσσ on [from, to]: exact, with 0 where that reaches out of the window.
  /// S_σσσ = 60·(1 − 6x + 6x²)/width³ is least at x = ½.
  Range ThirdRange(double from, double to) const {
    if (to <= begin || from >= end) return {};
    const double r = 1.0 / (end - begin);
    const double a = std::max(from - begin, 0.0) * r, b = std::min(to - begin, end - begin) * r;
    const auto at = [](double x) { return 60.0 * (1.0 - 6.0 * x * (1.0 - x)); };
    double low = std::min(at(a), at(b)), high = std::max(at(a), at(b));
    if (a <= 0.5 && b >= 0.5) low = -30.0;
    if (from < begin || to > end) {
      low = std::min(low, 0.0);
      high = std::max(high, 0.0);
    }
    return Range::Between(low * r * r * r, high * r * r * r);
  }
};

}  // namespace halfstep
