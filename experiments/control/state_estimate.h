#pragma once

#include "experiments/control/ankle_bush.h"
#include "experiments/control/tracking_controller.h"

namespace halfstep::control {

/// The CoM of the whole robot in the waist frame B [m], by the masses of the robot model.
/// Precondition: robot.masses.known().
Eigen::Vector3d CentreOfMass(const RobotModel& robot, const std::array<Vector6d, 2>& q);

/// Its velocity, seen from B [m/s], when the joints have these speeds [rad/s].
Eigen::Vector3d CentreOfMassVelocity(const RobotModel& robot, const std::array<Vector6d, 2>& q,
                                     const std::array<Vector6d, 2>& speeds);

/// Where a robot believes to be.
struct EstimatedState {
  Eigen::Isometry3d X_WB;             ///< of the waist
  Eigen::Vector3d com{0, 0, 0};       ///< of the whole robot, in W [m]
  Eigen::Vector3d velocity{0, 0, 0};  ///< of the CoM [m/s]
};

/// The state that follows from encoders, IMU and soles, without a filter. Roll and pitch are the
/// IMU's. Places are those that the soles that carry are planned to have: the centre of pressure,
/// a point that rests even when the sole rocks on an edge, is where the planned sole has it, and
/// the yaw is such that the sole's is the planned one; two soles count by their forces. Where
/// nothing carries, the waist is where it is planned. `bushes`: as they are turned then.
/// Precondition: robot.masses.known(). Source: [Caron2019] §III, experiments/replay.md, "Tracking
/// controllers".
EstimatedState EstimateState(const RobotModel& robot, const MeasuredState& measured,
                             const PlannedState& then, const std::array<AnkleBush, 2>& bushes);
/// The same of rigid ankles.
EstimatedState EstimateState(const RobotModel& robot, const MeasuredState& measured,
                             const PlannedState& then);

}  // namespace halfstep::control
