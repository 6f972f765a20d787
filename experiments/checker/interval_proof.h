#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <queue>
#include <vector>

#include "experiments/checker/interval.h"

namespace halfstep::checker {

/// A lower bound of x − limit, which is not below 0 where x is not below the limit.
inline double Beyond(double x, double limit) {
  const double margin = Below(x - limit);
  return x >= limit ? std::max(0.0, margin) : margin;
}

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();  ///< of margins

/// What is kept of a margin on an interval of time.
struct Kept {
  double bound = 0.0;         ///< at least that, at every instant
  double value = 0.0;         ///< about that in the middle
  bool hint_missing = false;  ///< no direction was told, which might show more

  /// All of an interval, and about what its middle has.
  static Kept Of(const Interval& over, const Interval& at) { return {over.lo, at.Middle()}; }
  /// limit − |x|.
  static Kept Under(double limit, const Interval& over, const Interval& at) {
    return {Beyond(limit, over.Magnitude()), limit - at.Magnitude()};
  }
  /// The lesser of both.
  friend Kept Least(const Kept& a, const Kept& b) {
    return {std::min(a.bound, b.bound), std::min(a.value, b.value)};
  }
};

/// What is known of a margin on an interval of time.
struct Part {
  double from = 0.0;   ///< [s]
  double to = 0.0;     ///< [s]
  double bound = 0.0;  ///< the margin is at least that, for all t of it
  double value = 0.0;  ///< and about that in the middle

  /// Of the interval [s].
  double middle() const { return 0.5 * from + 0.5 * to; }
  /// Of a queue the part with the least bound is on top.
  bool operator<(const Part& other) const { return bound > other.bound; }
};

/// Whether a margin is kept.
struct Proof {
  bool proved = false;         ///< at least what was demanded, for all t
  double least = 0.0;          ///< proved: no less is kept; else about what is kept at `at`
  double at = 0.0;             ///< in the part with the least bound [s]
  std::int64_t intervals = 0;  ///< that were looked at
};

/// Where intervals are cut: at a knot inside of them while there is one, else in the middle.
struct Span {
  double begin = 0.0;                          ///< [s]
  double end = 0.0;                            ///< [s]
  const std::vector<double>* knots = nullptr;  ///< growing [s]; null: none

  /// Whether a knot lies between both.
  bool HasKnot(double from, double to) const { return KnotIn(from, to) != to; }
  /// The middle one of the knots between both; none: `to`.
  double KnotIn(double from, double to) const {
    if (knots == nullptr) return to;
    const auto first = std::ranges::upper_bound(*knots, from);
    const auto last = std::ranges::lower_bound(*knots, to);
    return first < last ? *(first + (last - first) / 2) : to;
  }
};

/// Halves the part with the least bound until `ends(part, intervals)` of it, and returns it.
/// `look(from, to)` gives a Part.
template <typename Look, typename Ends>
Part Search(const Span& span, const Look& look, const Ends& ends, std::int64_t* intervals) {
  std::priority_queue<Part> parts;
  const auto add = [&](double from, double to) {
    parts.push(look(from, to));
    ++*intervals;
  };
  add(span.begin, span.end);
  while (!ends(parts.top())) {
    const Part part = parts.top();
    parts.pop();
    const double knot = span.KnotIn(part.from, part.to);
    const double cut = knot < part.to ? knot : part.middle();
    add(part.from, cut);
    add(cut, part.to);
  }
  return parts.top();
}

inline constexpr double kFinestPart = 1e-6;          ///< shorter parts are not halved [s]
inline constexpr std::int64_t kMostParts = 200'000;  ///< that are looked at

/// Whether a margin is at least `demanded` on a span. The part with the least bound is halved until
/// all bounds suffice, or that one is missed at its middle, is shorter than 1 µs or within 10⁻⁹ of
/// its value (halving helps no more), or 200,000 parts were looked at. The last three say that
/// nothing is proved, not that it is violated.
template <typename Look>
Proof Prove(const Span& span, double demanded, const Look& look) {
  constexpr double kMissed = 1e-9;
  Proof proof;
  const Part part = Search(
      span, look,
      [&](const Part& worst) {
        return worst.bound >= demanded || worst.value < demanded - kMissed ||
               worst.to - worst.from < kFinestPart || worst.value - worst.bound < kMissed ||
               proof.intervals >= kMostParts;
      },
      &proof.intervals);
  proof.proved = part.bound >= demanded;
  proof.least = proof.proved ? part.bound : part.value;
  proof.at = part.middle();
  return proof;
}

/// What a margin is at least on a span: by at most `off` less than its least value, where 200,000
/// parts suffice for that.
template <typename Look>
double LeastOf(const Span& span, double off, const Look& look, std::int64_t* intervals) {
  double seen = kInfinity;
  std::int64_t count = 0;
  const auto looked = [&](double from, double to) {
    const Part part = look(from, to);
    seen = std::min(seen, part.value);
    return part;
  };
  const Part part = Search(
      span, looked,
      [&](const Part& worst) {
        return seen - worst.bound <= off || worst.to - worst.from < kFinestPart ||
               count >= kMostParts || seen == -kInfinity;
      },
      &count);
  *intervals += count;
  return part.bound;
}

}  // namespace halfstep::checker
