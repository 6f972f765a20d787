#pragma once

#include <algorithm>
#include <cstdint>
#include <queue>

#include "experiments/checker/interval.h"

namespace halfstep::checker {

/// A lower bound of x − limit, which is not below 0 where x is not below the limit.
inline double Beyond(double x, double limit) {
  const double margin = Below(x - limit);
  return x >= limit ? std::max(0.0, margin) : margin;
}

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

/// Whether a margin is at least `demanded` on [begin, end]; `look(from, to)` gives a Part. The part
/// with the least bound is halved until all bounds suffice, or that one is missed at its middle, is
/// shorter than 1 µs or within 10⁻⁹ of its value (halving helps no more), or 200,000 parts were
/// looked at. The last three say that nothing is proved, not that it is violated.
template <typename Look>
Proof Prove(double begin, double end, double demanded, const Look& look) {
  constexpr double kFinest = 1e-6, kMissed = 1e-9;
  constexpr std::int64_t kMost = 200'000;
  Proof proof;
  std::priority_queue<Part> parts;
  const auto add = [&](double from, double to) {
    parts.push(look(from, to));
    ++proof.intervals;
  };
  add(begin, end);
  while (true) {
    const Part part = parts.top();
    proof.least = part.bound;
    proof.at = part.middle();
    proof.proved = part.bound >= demanded;
    if (proof.proved) return proof;
    if (part.value < demanded - kMissed || part.to - part.from < kFinest ||
        part.value - part.bound < kMissed || proof.intervals >= kMost) {
      proof.least = part.value;
      return proof;
    }
    parts.pop();
    add(part.from, part.middle());
    add(part.middle(), part.to);
  }
}

}  // namespace halfstep::checker
