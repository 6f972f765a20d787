#pragma once

#include <algorithm>
#include <utility>

#include "experiments/replay/simulation.h"
#include "wpg/motion/leg_torques.h"

namespace halfstep::replay {

/// A walk's motion at an instant, as the engine takes it. Precondition: joint speeds are solved.
inline RobotMotion RobotMotionAt(const RobotModel& robot, const WalkJet& jet,
                                 const Posture& posture, const RobotDynamics& dynamics) {
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  return {
      .X_WB = posture.X_WB,
      .velocity = posture.waist_velocity,
      .acceleration = WaistAcceleration(robot, jet, posture),
      .turn = jet.first[kWaistYaw] * z,
      .turn1 = jet.second[kWaistYaw] * z,
      .q = {posture.ik[0].q, posture.ik[1].q},
      .speeds = posture.speeds,
      .accelerations = {dynamics.accelerations(Side::kLeft), dynamics.accelerations(Side::kRight)}};
}

/// How far what the engine says of a motion is from the dynamics, without contacts: the largest
/// difference of joint torques, and of force and moment on the robot, over the largest of each
/// kind.
inline double OffFromEngine(const RobotForces& needed, const Posture& posture,
                            const RobotDynamics& dynamics) {
  Eigen::VectorXd engine(18), ours(18);
  const Vector6d& contact = dynamics.contact();
  const Eigen::Vector3d arm = posture.X_WB.translation() - dynamics.O(), force = contact.tail<3>();
  engine << needed.torques[0], needed.torques[1], needed.force, needed.moment;
  ours << LegTorques(dynamics, Side::kLeft, Vector6d::Zero()),
      LegTorques(dynamics, Side::kRight, Vector6d::Zero()), force,
      contact.head<3>() - arm.cross(force);
  double off = 0;
  for (const auto& [from, size] : {std::pair{0, 12}, std::pair{12, 3}, std::pair{15, 3}}) {
    off = std::max(off, (engine - ours).segment(from, size).cwiseAbs().maxCoeff() /
                            ours.segment(from, size).cwiseAbs().maxCoeff());
  }
  return off;
}

}  // namespace halfstep::replay
