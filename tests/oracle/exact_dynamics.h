#pragma once

#include <array>

#include "tests/oracle/exact_leg.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::oracle {

/// What a robot's masses ask for at one instant in the oracle's precision, by Newton's and Euler's
/// equations of each body.
struct ExactDynamics {
  /// At the walk's exact quantities, their rates and second derivatives; legs as SolveExactLeg has
  /// them, by Index(Side).
  ExactDynamics(const RobotModel& robot, const std::array<ExactLeg, 2>& legs,
                const std::array<ClosedFormWalk::Quantities, 3>& x);

  std::array<Real6, 2> accelerations;  ///< q̈ [rad/s²]
  Real3 pole{};                        ///< what moments are about, in W: below the waist's origin
  Real3 force{}, moment{};             ///< of the floor, about `pole`
  /// Of a joint: a point of its axis from `pole`, its direction, and what moves all that it
  /// carries. Of the link that it moves: ω, ω̇, and how that point moves with it.
  struct Joint {
    Real3 point{}, axis{}, force{}, moment{}, turn{}, turn1{}, velocity{}, acceleration{};
  };
  std::array<std::array<Joint, 6>, 2> joints;

  /// The ZMP in the plane z = height, in W: x and y.
  std::array<Real, 2> Zmp(Real height) const;
  /// The floor's moment about the vertical line through the ZMP of that plane.
  Real YawMoment(Real height) const;
  /// The torque of a joint while the floor gives its foot that force and that moment about `pole`.
  Real Torque(size_t leg, size_t joint, const Real3& on_foot, const Real3& moment_on_foot) const;
};

/// What the right one of two standing soles carries, FootLoads in the oracle's precision: force,
/// and moment about the pole. `x` are the walk's quantities.
std::array<Real3, 2> OnRightFoot(const ExactDynamics& dynamics, const ClosedFormWalk::Quantities& x,
                                 const Eigen::Vector2d& sole_size);

/// What one sole needs that stands alone: (‖f_t‖ + |n_z|/ρ)/f_z, ρ the larger of the distances of
/// the ZMP from its sides along and across. Negative: the ZMP is outside.
Real NeededFriction(const ExactDynamics& dynamics, const ClosedFormWalk::Quantities& x, Side side,
                    const Eigen::Vector2d& sole_size);

}  // namespace halfstep::oracle
