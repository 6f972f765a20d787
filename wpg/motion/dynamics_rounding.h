#pragma once

#include <Eigen/Core>
#include <array>

#include "wpg/motion/motion_bounds.h"
#include "wpg/motion/robot_dynamics.h"
#include "wpg/nth.h"

namespace halfstep {

/// How far rounding may carry the place, velocity and acceleration of a point of a body.
struct PointRounding {
  double place = 0.0;         ///< [m]
  double speed = 0.0;         ///< [m/s]
  double acceleration = 0.0;  ///< [m/s²]
};

/// How far rounding may carry the numbers of a RobotDynamics::Body from those of the exact body in
/// the exact walk: norms of differences. Twist and acceleration are spatial, about the same O.
struct BodyRounding {
  double turn = 0.0;                       ///< of a direction that is fixed in it [rad]
  double place = 0.0;                      ///< of any of its points [m]
  double spin = 0.0, velocity = 0.0;       ///< of the twist's two halves [rad/s], [m/s]
  double spin1 = 0.0, acceleration = 0.0;  ///< of the acceleration's [rad/s²], [m/s²]
  /// Of the body's force, but for what all of these do to it: of the arithmetic alone [N m], [N].
  double moment = 0.0, force = 0.0;

  /// Of a point of the body, which is `point` from O; `body` is as computed.
  PointRounding Of(const RobotDynamics::Body& body, const Eigen::Vector3d& point) const;
};

/// The same of a moment [N m] and a force [N].
struct WrenchRounding {
  double moment = 0.0;  ///< [N m]
  double force = 0.0;   ///< [N]
};

/// How far rounding may carry RobotDynamics at the midpoint of an interval: a running error bound
/// from what it does to quantities, angles, speeds and accelerations, along each leg. Source:
/// smoothing/README.md, "Rounding", 4.
struct DynamicsRounding {
  BodyRounding waist;                               ///< of the waist's body
  std::array<std::array<BodyRounding, 6>, 2> legs;  ///< of the links, by Index(Side)
  std::array<Vector6d, 2> accelerations;            ///< AccelerationRounding of the legs [rad/s²]
  WrenchRounding sums;                              ///< BodyRounding::moment and force, of all
  /// Whether all of this is finite. If not, nothing is said about the dynamics.
  bool known = false;

  /// Precondition: `motion` is bounded, `at_m` are the dynamics at its midpoint.
  static DynamicsRounding At(const RobotModel& robot, const IntervalMotion& motion,
                             const RobotDynamics& at_m, double gravity);

  /// Of the wrench of one body about a point that is `pole` from O.
  static WrenchRounding OfBody(const RobotDynamics::Body& body, const BodyRounding& off,
                               const Eigen::Vector3d& pole);
  /// Of what the floor gives, about such a point.
  WrenchRounding OfContact(const RobotDynamics& at_m, const Eigen::Vector3d& pole) const;
  /// Of the arithmetic alone in the forces of all bodies and any sums of them, about such a point.
  WrenchRounding OfSums(const Eigen::Vector3d& pole) const {
    return {sums.moment + pole.norm() * sums.force, sums.force};
  }
};

/// What rounding does to the moment I ω̇ + ω × I ω of a body about its centre of mass [N m], and to
/// how that changes: `turned`, `turn` and `turn1` are how far the body's direction [rad], ω and ω̇
/// may be from those computed.
double InertialMomentChange(const RobotDynamics::Body& body, double turned, double turn,
                            double turn1);

/// How far rounding may carry RobotDynamics::Zmp from where the computed contact() has it, at
/// `zmp`, in W [m].
double PlaceOfZmpRounding(const RobotDynamics& at_m, const Eigen::Vector3d& zmp);

/// How far a direction that is fixed in the waist may be from where it is computed [rad].
double WaistTurnRounding(const IntervalMotion& motion);
/// The same of all links and axes of that leg, in W.
double LegTurnRounding(const IntervalMotion& motion, Side side);

}  // namespace halfstep
