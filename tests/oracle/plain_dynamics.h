#pragma once

#include <Eigen/Geometry>
#include <array>

#include "tests/oracle/closed_form_walk.h"
#include "tests/oracle/plain_robot.h"

namespace halfstep::oracle {

/// What all links do at one instant and what the floor gives for it, by Newton's and Euler's
/// equations of every link of the URDF by itself, in vectors of W. Places are seen from a point of
/// the floor below the CoM, so that a walk far away costs no digits.
struct PlainDynamics {
  /// What moves all that a leg's joint carries: force, and moment about a point of its axis.
  struct Carried {
    Eigen::Vector3d point, axis, force{0, 0, 0}, moment{0, 0, 0};
  };

  /// `q` [rad] and `speed` [rad/s] of both legs are those of the walk at this instant.
  PlainDynamics(const PlainRobot& robot, const WalkState& state, const std::array<Vector6, 2>& q,
                const std::array<Vector6, 2>& speed);

  std::array<Vector6, 2> acceleration;  ///< of the legs' joints [rad/s²]
  Eigen::Vector3d below_com{0, 0, 0};   ///< where places are seen from, in W [m]
  Eigen::Vector3d force{0, 0, 0};       ///< of the floor on the robot [N]
  /// Where in the plane z = 0 the floor's moment is upright, seen from there [m].
  Eigen::Vector3d zmp{0, 0, 0};
  double yaw_moment = 0;  ///< that moment [N m]
  std::array<std::array<Carried, 6>, 2> carried;

  Eigen::Vector2d zmp_in_world() const { return (below_com + zmp).head<2>(); }
  /// The same in the plane z = h: the place is on a line along the force.
  Eigen::Vector2d zmp_at(double h) const {
    return zmp_in_world() + h / force.z() * force.head<2>();
  }
  /// That motor and gear give at a joint [N m] when the floor pushes the foot by `force` and, about
  /// the ZMP, `moment`.
  double Torque(size_t leg, size_t joint, const Eigen::Vector3d& force,
                const Eigen::Vector3d& moment) const;

 private:
  struct Frame;
  void Accelerate(const PlainRobot& robot, const WalkState& state, const Frame& waist,
                  const std::array<Vector6, 2>& q, const std::array<Vector6, 2>& speed);
};

}  // namespace halfstep::oracle
