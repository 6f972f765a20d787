#pragma once

#include <optional>

#include "smoothing/margins/margin.h"
#include "smoothing/margins/margin_place.h"
#include "smoothing/walk/superposed_walk.h"
#include "wpg/motion/contact_rate.h"
#include "wpg/motion/motion_bounds.h"
#include "wpg/motion/posture.h"
#include "wpg/motion/robot_drift.h"
#include "wpg/motion/robot_dynamics.h"
#include "wpg/motion/standing_heights.h"
#include "wpg/motion/zmp_drift.h"

namespace halfstep {

/// A walk at one instant, as the families see it. The posture is solved when it is first asked for.
/// What the constructors take is borrowed.
class Instant {
 public:
  /// The instant `at` of a walk; the walk is evaluated here.
  Instant(const MarginPlace& place, const MarginLimits& limits, const SuperposedWalk& walk,
          const LocalTime& at, MarginScratch* scratch);
  /// The same with quantities and a posture that are known already. Precondition: its joint speeds
  /// are solved.
  Instant(const MarginPlace& place, const MarginLimits& limits, const SuperposedWalk& walk,
          const LocalTime& at, const WalkJet& jet, const Posture& posture, MarginScratch* scratch);
  Instant(const Instant&) = delete;
  Instant& operator=(const Instant&) = delete;

  /// Robot, scene and what is prepared of them.
  const MarginPlace& place() const { return place_; }
  const RobotModel& robot() const { return place_.robot; }  ///< of the place
  const MarginLimits& limits() const { return limits_; }    ///< limits and demanded margins
  /// What is demanded of a family [its unit].
  double demanded(MarginFamily family) const { return limits_.demanded_of(family); }
  const SuperposedWalk& walk() const { return walk_; }  ///< to which the instant belongs
  const LocalTime& at() const { return at_; }           ///< its name in the walk
  double t() const { return walk_.Absolute(at_); }      ///< absolute time in the walk [s]
  const WalkJet& jet() const { return jet_; }  ///< all quantities and two time derivatives, in W
  /// The step whose foot is in the air (its up half-step is 2·step), or −1. swing() is that foot,
  /// and has a meaning only when there is one.
  int step_in_air() const { return step_; }
  Side swing() const { return walk_.half_step(2 * step_).swing(); }  ///< the foot in the air

  /// Whether both legs reach, which is a precondition of most uses of the posture.
  bool reachable() { return posture().reachable; }
  /// Whether both legs reach and neither is stretched to the singularity; then the posture's joint
  /// speeds are solved.
  bool regular();
  const Posture& posture();  ///< of the whole robot; joint speeds only when regular()
  /// The dynamics of the whole robot; null where nothing can be said, because a leg does not reach
  /// or is stretched, or masses are not known.
  const RobotDynamics* dynamics();
  /// The same where masses are not known: then it has velocities and accelerations only.
  const RobotDynamics* motion();
  /// The soles that support the robot there, seen from above (SupportAt); made when it is first
  /// asked for.
  const SupportPolygon& support();
  /// The heights at which these soles stand.
  StandingHeights heights() const;
  MarginScratch& scratch() const { return scratch_; }  ///< what families remember between instants

 private:
  const MarginPlace& place_;
  const MarginLimits& limits_;
  const SuperposedWalk& walk_;
  LocalTime at_;
  MarginScratch& scratch_;
  WalkJet jet_;
  int step_ = -1;
  Posture own_;
  const Posture* posture_ = nullptr;  // null: not solved yet
  bool speeds_tried_ = false, regular_ = false;
  std::optional<RobotDynamics> motion_;
  std::optional<SupportPolygon> support_;
};

/// An interval of time around an instant, [mid − h, mid + h], and bounds of how much the motion
/// changes in it. Strictly inside, no foot lifts off or touches down, and none begins or ends its
/// horizontal motion.
class MarginInterval {
 public:
  /// `mid` and `motion` are borrowed. `with_margins`: margins are wanted, not only verdicts, which
  /// is slower.
  MarginInterval(Instant* mid_instant, const IntervalMotion& its_motion, bool margins_wanted)
      : mid(*mid_instant), motion(its_motion), with_margins(margins_wanted) {}

  Instant& mid;                  ///< the instant at the interval's middle
  const IntervalMotion& motion;  ///< bounds of the motion around it
  const bool with_margins;       ///< whether margins are told where a bound would do

  /// No lower than here is a sole within the interval, in W [m].
  double LeastSole(Side side) const;

  /// How much the motion of all bodies differs from that at the midpoint. Precondition:
  /// mid.motion() is not null. Where masses are not known, what it says of masses means nothing.
  const RobotDrift& drift() const;
  /// How far the robot's ZMP goes in the plane halfway between the soles that stand
  /// (StandingHeights::middle). Precondition: there is one at the midpoint.
  const ZmpDrift& zmp_drift() const;
  /// How fast what the floor gives changes, about the ZMP of that plane; null where the interval is
  /// too long to say. It costs several times as much as the drifts, and says more. Precondition: as
  /// zmp_drift().
  const ContactRate* contact_rate() const;
  /// How far rounding may carry the soles that stand from where they are computed, as the line of
  /// the robot's ZMPs sees them: corners, for a point that is `inside` of them by so much, and
  /// heights [m]. `zmp` bounds what the floor gives; +∞ where that has no bound. Precondition: as
  /// zmp_drift().
  double SolesOff(double inside, const ZmpDrift& zmp) const;

 private:
  const WalkThirds& Thirds() const;

  // Made when they are first asked for.
  mutable std::optional<WalkThirds> thirds_;
  mutable std::optional<RobotDrift> drift_;
  mutable std::optional<ZmpDrift> zmp_drift_;
  mutable std::optional<std::optional<ContactRate>> contact_rate_;
};

}  // namespace halfstep
