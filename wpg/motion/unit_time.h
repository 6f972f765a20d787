#pragma once

#include "wpg/motion/profile_jet.h"
#include "wpg/motion/vector_ball.h"
#include "wpg/rounded.h"

namespace halfstep {

/// The time of a half-step in units of its duration, σ = τ/T, and what turns derivatives in σ into
/// those in time. Functions of σ alone, and of θ = ω·T where that is told.
struct UnitTime {
  double duration;     ///< T [s] > 0
  double omega = 0.0;  ///< [1/s]

  double Of(double tau) const { return tau / duration; }  ///< σ of a local time [s]
  /// The jet in time of f, taken at σ.
  ProfileJet Jet(const UnitJet& f, double sigma) const { return ToTime(f, sigma, duration, omega); }
  /// The derivative of a profile along a parameter, from f, its derivative along a number that
  /// changes by `rate` per unit of that parameter: value, first and second.
  ProfileJet Slope(const UnitJet& f, double rate) const {
    const double r = 1.0 / duration;
    return {.value = rate * f.value, .first = rate * r * f.s, .second = rate * r * r * f.ss};
  }
  /// A second derivative.
  double Second(double f_ss) const { return 1.0 / (duration * duration) * f_ss; }
  /// A range of third derivatives.
  Range Third(const Range& f_sss) const {
    const double r = 1.0 / (duration * duration * duration);
    return {r * f_sss.center, r * f_sss.radius};
  }
  /// How Jet is computed, local times off by at most `time` [s].
  ProfileAccuracy Accuracy(const UnitAccuracy& of, double time) const {
    const double r = 1.0 / duration, off = time * r + 2.0 * kRoundoff;
    return {.error = {.value = of.error.value + of.most.s * off,
                      .first = r * (of.error.s + of.most.ss * off + 4.0 * kRoundoff * of.most.s),
                      .second =
                          r * r * (of.error.ss + of.most.sss * off + 6.0 * kRoundoff * of.most.ss)},
            .most = {.value = of.most.value, .first = r * of.most.s, .second = r * r * of.most.ss}};
  }
};

}  // namespace halfstep
