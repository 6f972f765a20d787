#pragma once

#include <Eigen/Core>
#include <array>

#include "wpg/motion/dynamics_rounding.h"
#include "wpg/motion/motion_bounds.h"
#include "wpg/motion/rigid_drift.h"
#include "wpg/motion/robot_dynamics.h"
#include "wpg/motion/walk_thirds.h"

namespace halfstep {

/// The drifts of the waist and of a sole over an interval, at their origins, from bounds of the
/// walk's second derivatives (IntervalMotion) and third ones.
RigidDrift DriftOfWaist(const RobotModel& robot, const IntervalMotion& motion,
                        const WalkThirds& thirds);
/// The same of the sole of that side.
RigidDrift DriftOfSole(const IntervalMotion& motion, const WalkThirds& thirds, Side side);

/// How much the motion of a leg's links, up to accelerations, differs over an interval from what it
/// is at the midpoint m, both exact. Links 0–2 hang on the waist and links 3–5 on the sole, so that
/// nothing is carried over more than three joints. The joints' accelerations solve J q̈ = V̇ − J̇ q̇
/// over the interval, with J⁻¹ that at m and the bounds of q̈ that IntervalMotion has. For both
/// kinds of legs. Source: smoothing/README.md, "The robot's ZMP between instants".
struct LegDrift {
  std::array<RigidDrift, 6> links;        ///< of the six links, from the hip down
  std::array<Eigen::Vector3d, 6> points;  ///< the links' points at m, in W [m]
  std::array<JointDrift, 6> joints;       ///< of the six joints, from the hip down

  /// Preconditions: `motion` is bounded, `at_m` are the dynamics at m. `waist` and `sole` are those
  /// at the waist's and the sole's origins, `off` what rounding does to at_m.
  static LegDrift Over(Side side, const IntervalMotion& motion, const RigidDrift& waist,
                       const RigidDrift& sole, const RobotDynamics& at_m,
                       const DynamicsRounding& off);
};

}  // namespace halfstep
