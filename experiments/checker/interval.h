#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "wpg/elementary.h"

namespace halfstep::checker {

/// Less than x by at least half a unit in its last place, and by so much that products of results
/// are normal numbers: others cost a hundred times the time.
inline double Below(double x) { return x - (std::abs(x) * 0x1p-52 + 0x1p-400); }
/// The same upwards.
inline double Above(double x) { return x + (std::abs(x) * 0x1p-52 + 0x1p-400); }

/// All real numbers from `lo` to `hi`. Whatever numbers are taken from the operands, the exact
/// result lies in the result: sums, products and roots of doubles are correctly rounded, and each
/// bound is moved outwards by more than that. Trusted: IEEE 754 arithmetic, rounding to nearest.
struct Interval {
  double lo = 0.0;  ///< no number of it is less
  double hi = 0.0;  ///< nor more

  Interval() = default;
  /// One number.
  Interval(double x) : lo(x), hi(x) {}  // NOLINT: a double is a number
  /// All from `lower` to `upper`.
  Interval(double lower, double upper) : lo(lower), hi(upper) {}

  /// A number of it.
  double Middle() const { return 0.5 * lo + 0.5 * hi; }
  /// No number of it is farther from `x`.
  double FarthestFrom(double x) const { return std::max(Above(hi - x), Above(x - lo)); }
  /// The largest absolute value.
  double Magnitude() const { return std::max(std::abs(lo), std::abs(hi)); }
  bool operator==(const Interval&) const = default;  ///< both bounds
};

inline Interval operator+(const Interval& a, const Interval& b) {
  return {Below(a.lo + b.lo), Above(a.hi + b.hi)};
}
inline Interval operator-(const Interval& a) { return {-a.hi, -a.lo}; }
inline Interval operator-(const Interval& a, const Interval& b) { return a + (-b); }
inline Interval operator*(const Interval& a, const Interval& b) {
  const double p = a.lo * b.lo, q = a.lo * b.hi, r = a.hi * b.lo, s = a.hi * b.hi;
  return {Below(std::min({p, q, r, s})), Above(std::max({p, q, r, s}))};
}
/// Precondition: 0 is not in b.
inline Interval operator/(const Interval& a, const Interval& b) {
  const double p = a.lo / b.lo, q = a.lo / b.hi, r = a.hi / b.lo, s = a.hi / b.hi;
  return {Below(std::min({p, q, r, s})), Above(std::max({p, q, r, s}))};
}

/// The smallest interval that holds both.
inline Interval Hull(const Interval& a, const Interval& b) {
  return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
}
/// x² ≥ 0.
inline Interval Square(const Interval& a) {
  const double most = a.Magnitude(), least = std::max({0.0, a.lo, -a.hi});
  return {std::max(0.0, Below(least * least)), Above(most * most)};
}
/// √x of what of it is ≥ 0.
inline Interval Sqrt(const Interval& a) {
  return {std::max(0.0, Below(std::sqrt(std::max(0.0, a.lo)))),
          Above(std::sqrt(std::max(0.0, a.hi)))};
}

/// Sine and cosine of every number of an interval.
struct SineCosineInterval {
  Interval sin, cos;  ///< within [−1, 1]
};
/// By sine and cosine of the middle, and since neither changes faster than its argument. Trusted:
/// wpg/elementary, off by at most a unit in the last place (2⁻⁵² ≥ that of any sine).
inline SineCosineInterval SinCosOf(const Interval& a) {
  const double middle = a.Middle();
  const double off = Above(a.FarthestFrom(middle) + 0x1p-52);
  const SineCosine at = SinCos(middle);
  const auto around = [off](double x) {
    return Interval(std::max(-1.0, Below(x - off)), std::min(1.0, Above(x + off)));
  };
  return {around(at.sin), around(at.cos)};
}

}  // namespace halfstep::checker
