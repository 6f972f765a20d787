#pragma once

#include <vector>

#include "wpg/geometry/foothold.h"
#include "wpg/geometry/side.h"
#include "wpg/motion/lipm.h"
#include "wpg/motion/profile_jet.h"
#include "wpg/motion/ramped_step.h"
#include "wpg/motion/rest_to_rest.h"
#include "wpg/motion/smoothstep.h"
#include "wpg/motion/walk_state.h"

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

  /// All of them, in this order; one that is left out does not compile.
  std::array<double, 6> numbers() const {
    const auto& [a, b, c, d, e, f] = *this;
    return {a, b, c, d, e, f};
  }
  double t1() const { return 0.5 - 0.5 * shift; }  ///< of T
  double t2() const { return 0.5 + 0.5 * shift; }  ///< of T
  friend bool operator==(const HalfStepShape&, const HalfStepShape&) = default;
};

/// Half a step, from rest to rest, the support foot fixed at the origin of S.
///
///   z │            ╭──● via point (via_along, ±via_lateral, via_height)
///     │          ╭─╯        Up:   the swing foot goes from X_SF to the via point, the CoM and the
///     │        ╭─╯                ZMP from mid-feet to the support point, the waist's yaw from
///     │        │                  the mean of the feet's yaws to the support's.
///   ──┴────────┴──────▶ x   Down: the time reverse, towards a new X_SF.
///            X_SF
///
/// ZMP: bump on [0, t1], shift on [t1, t2], bump on [t2, T]. The foot is in the air only on (t2, T]
/// (up) or [0, t1) (down). Left and right are mirror images.
/// Source: [Perrin2011] §III; wpg/README.md, "Half-step".
struct HalfStep {
  Side support = Side::kLeft;             ///< the foot that stands
  HalfStepKind kind = HalfStepKind::kUp;  ///< up: towards the via point; down: from it
  Foothold X_SF;              ///< where the swing sole stands, seen from the support sole.
  double duration = 2.0;      ///< T [s]
  double via_height = 0.25;   ///< [m] ≥ 0
  double via_lateral = 0.24;  ///< distance of the via point from the support sole's centre [m].
  double via_along = 0.0;     ///< how far the via point is ahead of that centre, along its x [m]
  HalfStepShape shape;        ///< times and forms, as fractions of T

  Side swing() const { return Opposite(support); }  ///< the foot that moves
  /// The pose X_SV of the via point seen from above: there the swing foot is between up and down.
  Pose2 via() const { return {via_along, Sign(swing()) * via_lateral, 0.0}; }
  /// The support point, in S: CoM and ZMP are there while the swing foot is at the via point.
  Eigen::Vector2d support_point() const { return {0.0, Sign(swing()) * shape.support_point}; }
  /// The states at rest, in S: with both feet standing, and at the via point.
  WalkState OnFloor() const;
  WalkState AtVia() const;  ///< with the swing foot at the via point
  /// Where the half-step begins.
  WalkState Start() const { return kind == HalfStepKind::kUp ? OnFloor() : AtVia(); }
  /// Where it ends.
  WalkState End() const { return kind == HalfStepKind::kUp ? AtVia() : OnFloor(); }

  HalfStep Mirrored() const;  ///< left and right exchanged: the reflection in the xz plane
  friend bool operator==(const HalfStep&, const HalfStep&) = default;
};

/// The profile that each quantity of a half-step follows: x(τ) = Start + π(τ)·(End − Start).
struct HalfStepJet {
  ProfileJet com, zmp, yaw, foot, height;  ///< foot: x, y and yaw of the swing foot; height: its z.

  /// The profile of a Quantity.
  const ProfileJet& of(int quantity) const;
};

/// What holds the third time derivatives of the profiles over an interval [1/s³].
struct HalfStepThirds {
  Range com, yaw, foot, height;  ///< as in HalfStepJet; that of the ZMP is not bounded.
};

/// The profiles of a half-step of given kind, shape and duration [s] under a LIPM; immutable.
class HalfStepProfiles {
 public:
  /// Precondition: the shape in its ranges, ω·duration ∈ [0.5, 60] (std::logic_error).
  HalfStepProfiles(HalfStepKind kind, const HalfStepShape& shape, double duration,
                   const Lipm& lipm);

  /// The profiles at local time τ [s]: 0 and at rest before 0, 1 and at rest after T.
  HalfStepJet At(double tau) const;

  /// Derivatives of value, first and second at τ with respect to shift, bump_ramp,
  /// foot_delay, foot_ramp or lift_share of the shape (std::logic_error for another number).
  /// At a knot: of one side.
  HalfStepJet ByShape(double HalfStepShape::*number, double tau) const;

  /// sup |π̈| [1/s²] of each profile over local times [from, to] [s]; only `second` is filled.
  HalfStepJet SecondBounds(double from, double to) const;

  /// All values of the third time derivatives over local times [from, to] [s], but for 2·10⁻¹³ T at
  /// either end: between knots at absolute times these may belong to the piece beyond the knot, by
  /// rounding. What the walk does in that time is far below what margins add for rounding.
  HalfStepThirds ThirdRanges(double from, double to) const;

  double duration() const { return duration_; }          ///< T [s]
  double t1() const { return shape_.t1() * duration_; }  ///< end of the ZMP's first rest [s]
  double t2() const { return shape_.t2() * duration_; }  ///< begin of its second rest [s]
  /// The swing foot moves horizontally between these local times [s].
  double horizontal_begin() const { return foot_.begin * duration_; }
  double horizontal_end() const { return foot_.end * duration_; }  ///< and ends here [s]
  /// The swing foot rises (up) or sinks (down) between these local times [s].
  double lift_begin() const { return height_.begin * duration_; }
  double lift_end() const { return height_.end * duration_; }  ///< and ends here [s]
  /// Local times at which a profile changes its formula, 0 left out, in no order [s].
  std::vector<double> Knots() const;
  double bump() const { return shift_.bump(); }  ///< of the ZMP (RestToRest::bump).

 private:
  HalfStepJet ByShift(double sigma) const;

  HalfStepShape shape_;
  double duration_;
  double omega_;
  RampedStep foot_;
  Smoothstep height_;
  RestToRest shift_;
};

/// All quantities of an isolated half-step at local time τ [s], clamped to [0, T], in S.
WalkJet Evaluate(const HalfStep& half_step, const HalfStepProfiles& profiles, double tau);

}  // namespace halfstep
