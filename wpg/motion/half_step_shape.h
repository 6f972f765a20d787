#pragma once

#include <array>

namespace halfstep {

/// From the floor up to the via point, or down from it to the floor.
enum class HalfStepKind { kUp, kDown };

/// How a half-step moves. Times are fractions of its duration T, so that they scale with T.
struct HalfStepShape {
  double shift = 0.05;  ///< (t2 − t1)/T: the ZMP shifts on [t1, t2], centred at T/2. ∈ [0.01, 0.5]
  /// The swing foot's horizontal motion begins this fraction of T after take-off and ends this
  /// fraction before landing. ∈ [0, 0.3], ≤ 0.9·t1
  double foot_delay = 0.1;
  /// The ZMP's bump rises, and falls, for this fraction of its length and is constant in between;
  /// from ½ on it has no flat top, and 1 is the round bump (RestToRest). ∈ [0.1, 1]
  double bump_ramp = 1.0;
  /// The swing foot's horizontal speed rises, and falls, for this fraction of its motion, and is
  /// constant in between; ½: never constant. ∈ [0.1, 0.5]
  double foot_ramp = 0.5;
  /// The swing foot rises in this fraction of its flight after take-off, and sinks in the same
  /// fraction before landing. ∈ [0.2, 1]
  double lift_share = 1.0;
  /// Where CoM and ZMP rest while the swing foot is at the via point: so far from the support
  /// sole's centre, along its y, towards the swing foot [m]. Below 0: away from it.
  double support_point = 0.0;
  /// Where the swing foot stands lower than the support foot, the waist rises in an up half-step
  /// from this fraction of T on, ∈ [0, 0.75], and sinks in a down half-step until this fraction
  /// before its end.
  double rise_begin = 0.525;
  /// It has risen by this fraction of T, ∈ [0.85, 1]. In a down half-step: it begins to sink this
  /// fraction before the end.
  double rise_end = 1.0;
  /// How far the waist is kept below where the robot file has it [m] ≥ 0, for higher steps.
  double crouch = 0.0;

  /// All of them, in this order; one that is left out does not compile.
  std::array<double, 9> numbers() const {
    const auto& [a, b, c, d, e, f, g, h, i] = *this;
    return {a, b, c, d, e, f, g, h, i};
  }
  double t1() const { return 0.5 - 0.5 * shift; }  ///< of T
  double t2() const { return 0.5 + 0.5 * shift; }  ///< of T
  friend bool operator==(const HalfStepShape&, const HalfStepShape&) = default;
};

}  // namespace halfstep
