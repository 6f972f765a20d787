#pragma once

#include <array>
#include <optional>

#include "wpg/motion/leg_drift.h"
#include "wpg/motion/motion_bounds.h"
#include "wpg/motion/rigid_motion.h"
#include "wpg/motion/robot_dynamics.h"
#include "wpg/motion/walk_thirds.h"

namespace halfstep {

/// What the waist's body does over an interval. Its point is the one below the CoM at the height of
/// the waist's origin, which moves as the CoM does.
RigidMotion MotionOfWaist(const RobotModel& robot, const IntervalMotion& motion,
                          const WalkThirds& thirds);
/// The same of a sole; its point is the sole's origin.
RigidMotion MotionOfSole(const IntervalMotion& motion, const WalkThirds& thirds, Side side);

/// What a leg's links do over an interval, up to third derivatives. As LegDrift, of which it takes
/// bounds of all that is of a lower order; the joints' third derivatives solve
/// J q⃛ = V̈ − 2 J̇ q̈ − J̈ q̇ over the interval. Tighter than LegDrift by far where the interval is
/// short, and several times as costly. Source: smoothing/README.md, "Rates between instants".
struct LegMotion {
  /// Of the six links, from the hip down; their points are those of LegDrift.
  std::array<RigidMotion, 6> links;

  /// Preconditions: `motion` is bounded, `at_m` are the dynamics at m under `gravity`, `off` is
  /// what rounding does to them, `drift` is the leg's. None where no bound of the joints' third
  /// derivatives is found, because the interval is too long.
  static std::optional<LegMotion> Over(Side side, const IntervalMotion& motion,
                                       const RigidMotion& waist, const RigidMotion& sole,
                                       const LegDrift& drift, const RobotDynamics& at_m,
                                       const DynamicsRounding& off, double gravity);
};

}  // namespace halfstep
