#pragma once

#include <array>
#include <optional>

#include "wpg/motion/motion_bounds.h"
#include "wpg/motion/rigid_motion.h"
#include "wpg/motion/robot_dynamics.h"
#include "wpg/motion/walk_thirds.h"

namespace halfstep {

/// How the waist and all links of the legs move over an interval, up to third derivatives. Links
/// 0–2 of a leg hang on the waist and links 3–5 on the sole, so that nothing is carried over more
/// than three joints. The joints' third derivatives solve J q⃛ = V̈ − 2 J̇ q̈ − J̈ q̇ over the interval,
/// with J⁻¹ that at its midpoint. For both kinds of legs. Source: smoothing/README.md, "The robot's
/// ZMP between instants".
struct LinkMotions {
  RigidMotion waist;  ///< its point: below the CoM at the waist's height
  std::array<std::array<RigidMotion, 6>, 2> links;
  std::array<std::array<Range, 6>, 2> speeds, accelerations, thirds;  ///< of the joints

  /// None where the interval is too long or a leg too near to singular for a bound. Precondition:
  /// `motion` is bounded, and `at_m` are the dynamics at its midpoint.
  static std::optional<LinkMotions> Over(const RobotModel& robot, const IntervalMotion& motion,
                                         const WalkThirds& thirds, const RobotDynamics& at_m);
};

}  // namespace halfstep
