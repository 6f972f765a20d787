#pragma once

#include <Eigen/Core>
#include <array>

#include "wpg/motion/dynamics_slope.h"
#include "wpg/motion/robot_dynamics.h"

namespace halfstep {

/// The derivative of RobotDynamics::Zmp along any tangent. Exact; made once an instant by an
/// adjoint sweep over the links, so that each tangent costs some products only. Source:
/// wpg/README.md, "Dynamics of the whole robot"; [Singh2022].
class ZmpSlopes {
 public:
  /// Precondition: dynamics.Zmp() exists.
  ZmpSlopes(const RobotModel& robot, const WalkJet& jet, const Posture& posture,
            const RobotDynamics& dynamics);

  /// ∂ZMP/∂parameter in W [m per unit].
  Eigen::Vector2d Along(const DynamicsTangent& tangent) const;

 private:
  using Rows = Eigen::Matrix<double, 2, 6>;
  struct LegRows {
    Rows by_q, by_speed;  // with q̈ as the sole demands it
    Rows by_sole;         // of the sole's spatial acceleration
  };

  const RobotModel& robot_;
  const WalkJet& jet_;
  const Posture& posture_;
  const RobotDynamics& dynamics_;
  Rows by_force_;  // of the contact force about O
  Rows by_drift_;  // of a velocity that all bodies gain
  Rows by_push_;   // of an acceleration that all bodies gain
  std::array<LegRows, 2> legs_;
};

}  // namespace halfstep
