#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "wpg/motion/posture.h"
#include "wpg/motion/spatial.h"
#include "wpg/nth.h"

namespace halfstep {

/// The dynamics of the whole robot at one instant of a walk: masses and inertias of all links,
/// angular momentum included. Links outside the legs are rigid with the waist. In closed form from
/// the joints' angles, speeds and accelerations; these follow from the walk's quantities by
/// J q̇ = V, J q̈ = V̇ − J̇ q̇. Spatial vectors about O, the point of the floor below the waist's
/// origin, in the axes of W. Source: wpg/README.md, "Dynamics of the whole robot".
class RobotDynamics {
 public:
  /// A body: its parent joint's screw (zero for the waist), its velocity, its acceleration and that
  /// less gravity's −g ẑ, and the force that moves it against gravity and inertia.
  struct Body {
    Vector6d screw = Vector6d::Zero();         ///< of the joint that moves it, about O
    Vector6d velocity = Vector6d::Zero();      ///< of the body, as a twist about O
    Vector6d acceleration = Vector6d::Zero();  ///< with + g ẑ: what an accelerometer feels
    SpatialInertia inertia;                    ///< of the body, about O
    Vector6d force = Vector6d::Zero();         ///< moment about O [N m], force [N]
  };
  using LegBodies = std::array<Body, 6>;  ///< of one leg, from the hip down

  /// Preconditions: the posture is reachable and its joint speeds are solved. Where masses are not
  /// known, only velocities and accelerations mean something: contact() is not a number, and there
  /// is no ZMP.
  RobotDynamics(const RobotModel& robot, const WalkJet& jet, const Posture& posture,
                double gravity);

  const Eigen::Vector3d& O() const { return O_; }  ///< in W [m]
  const Body& waist() const { return waist_; }  ///< the waist's body and all that is rigid with it
  /// Of that leg.
  const LegBodies& leg(Side side) const { return Nth(legs_, Index(side)); }
  /// q̈ [rad/s²].
  const Vector6d& accelerations(Side side) const { return Nth(accelerations_, Index(side)); }
  /// What the floor gives: moment about O [N m], and force [N].
  const Vector6d& contact() const { return contact_; }
  /// Where the floor's force has no horizontal moment in the plane z = `height` [m], in W [m]; none
  /// where it does not push. These points are a line along the force.
  std::optional<Eigen::Vector2d> Zmp(double height = 0.0) const;
  /// By how much that line goes aside for each metre that it rises: f_t/f_z. Precondition: there is
  /// a ZMP, as for what follows.
  Eigen::Vector2d Tilt() const { return contact_.segment<2>(3) / contact_[5]; }
  /// The ZMP's derivative when contact() changes by `contact_slope`.
  Eigen::Vector2d ZmpSlope(const Vector6d& contact_slope, double height = 0.0) const;
  /// The gradient of `along` · ZMP with respect to contact().
  Vector6d ZmpGradient(const Eigen::Vector2d& along, double height = 0.0) const;

 private:
  Eigen::Vector3d O_;
  Body waist_;
  std::array<LegBodies, 2> legs_;
  std::array<Vector6d, 2> accelerations_;
  Vector6d contact_;
};

/// The derivative of RobotDynamics::Tilt when `contact` changes by `contact_slope`. Precondition:
/// contact[5] > 0.
Eigen::Vector2d TiltSlope(const Vector6d& contact, const Vector6d& contact_slope);

/// Spatial acceleration and velocity about O of a frame that stays upright: its origin is at `p`
/// from O [m], and moves by `v`, `a`; its yaw by `rate`, `acceleration`.
Vector6d UprightVelocity(const Eigen::Vector3d& p, const Eigen::Vector3d& v, double rate);
/// The spatial acceleration of that frame about O.
Vector6d UprightAcceleration(const Eigen::Vector3d& p, const Eigen::Vector3d& v,
                             const Eigen::Vector3d& a, double rate, double acceleration);

/// The waist's acceleration [m/s²], for the CoM is rigid in its frame.
Eigen::Vector3d WaistAcceleration(const RobotModel& robot, const WalkJet& jet,
                                  const Posture& posture);

}  // namespace halfstep
