#pragma once

namespace halfstep {

/// Work that was done, by kind. It is counted in place of time, so what it ends does not depend on
/// the machine, on what else runs there, or on how many threads there are.
struct Work {
  long instants = 0;        ///< of walks that were evaluated without derivatives
  long derivatives = 0;     ///< of walks that were evaluated with derivatives
  long intervals = 0;       ///< that proofs bounded
  long linear_algebra = 0;  ///< opt::Solution::linear_algebra: multiplications

  /// All of it in one unit: 1 is about a second of one core of 2026. The weights are what each kind
  /// took there for HRP-2. Source: smoothing/README.md, "Effort".
  double effort() const {
    return 1e-6 * (kInstant * static_cast<double>(instants) +
                   kDerivative * static_cast<double>(derivatives) +
                   kInterval * static_cast<double>(intervals) +
                   kMultiplication * static_cast<double>(linear_algebra));
  }
  /// Of all kinds at which margins were evaluated.
  long evaluated() const { return instants + derivatives + intervals; }

  /// Adds each kind.
  Work& operator+=(const Work& other) {
    instants += other.instants;
    derivatives += other.derivatives;
    intervals += other.intervals;
    linear_algebra += other.linear_algebra;
    return *this;
  }
  /// What was done after `b`, of a.
  friend Work operator-(Work a, const Work& b) {
    a.instants -= b.instants;
    a.derivatives -= b.derivatives;
    a.intervals -= b.intervals;
    a.linear_algebra -= b.linear_algebra;
    return a;
  }
  friend bool operator==(const Work&, const Work&) = default;

  static constexpr double kInstant = 7.0;            ///< what an instant takes [µs]
  static constexpr double kDerivative = 14.0;        ///< what one with derivatives takes [µs]
  static constexpr double kInterval = 27.0;          ///< what an interval takes [µs]
  static constexpr double kMultiplication = 0.8e-3;  ///< what a multiplication takes [µs]
};

}  // namespace halfstep
