#pragma once

#include <Eigen/Core>

#include "wpg/motion/dynamics_rounding.h"
#include "wpg/motion/rigid_drift.h"
#include "wpg/motion/robot_dynamics.h"

namespace halfstep {

/// What a body's mass asks for at the midpoint m of an interval, and how much the exact body's
/// differs from that over the interval: suprema of norms of differences. In the axes of W.
struct MassDrift {
  double mass = 0.0;                      ///< [kg]
  Eigen::Vector3d com{0, 0, 0};           ///< centre of mass at m, from the dynamics' O [m]
  Eigen::Vector3d velocity{0, 0, 0};      ///< of that, at m [m/s]
  Eigen::Vector3d acceleration{0, 0, 0};  ///< at m, gravity not included [m/s²]
  double p = 0.0, p2 = 0.0;               ///< drift of its place [m] and acceleration [m/s²]
  double moment = 0.0;                    ///< drift of I ω̇ + ω × I ω about it [N m]
  PointRounding off = {};                 ///< of what it is at m; p and p2 contain it

  /// Sup of its acceleration's size [m/s²].
  double MostAcceleration() const { return acceleration.norm() + p2; }

  /// `of_com` is the drift of the body with its centre of mass as the point, `off` what rounding
  /// does to the body at m.
  static MassDrift Of(const RobotDynamics::Body& body, const RigidDrift& of_com, double gravity,
                      const BodyRounding& off = {});
};

}  // namespace halfstep
