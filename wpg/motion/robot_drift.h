#pragma once

#include <array>

#include "wpg/motion/leg_drift.h"
#include "wpg/motion/mass_drift.h"

namespace halfstep {

/// How much the motion of all of a robot's bodies, and what their masses ask for, differ over an
/// interval from what they are at the midpoint m: of rigid motion the exact one's from the exact
/// one, of masses the exact one's from the computed one.
struct RobotDrift {
  DynamicsRounding rounding;     ///< at m
  RigidDrift waist;              ///< of the waist's origin
  std::array<LegDrift, 2> legs;  ///< by Index(Side)
  MassDrift waist_mass;          ///< of the waist's body and all that is rigid with it
  std::array<std::array<MassDrift, 6>, 2> link_masses;  ///< by Index(Side) and link

  /// Preconditions: `motion` is bounded, `at_m` are the dynamics at m. Where rounding is not known,
  /// only that means anything.
  RobotDrift(const RobotModel& robot, const IntervalMotion& motion, const WalkThirds& thirds,
             const RobotDynamics& at_m, double gravity);

  /// How much the floor's force differs at most [N].
  double ForceDrift() const;
  /// How much the moment about a vertical line through `point`, from the dynamics' O, differs [N
  /// m].
  double YawMomentDrift(const Eigen::Vector3d& point) const;
};

}  // namespace halfstep
