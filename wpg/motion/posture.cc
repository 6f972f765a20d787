#include "wpg/motion/posture.h"

namespace halfstep {

Posture SolvePosture(const RobotModel& robot, const WalkState& x) {
  Posture posture;
  const Pose2 X_WC{x[kComX], x[kComY], x[kWaistYaw]};
  posture.X_WB =
      ToIsometry(X_WC * Pose2{-robot.com_x_B, 0.0, 0.0}, robot.waist_height + x[kWaistZ]);
  posture.reachable = true;
  const Eigen::Isometry3d X_BW = posture.X_WB.inverse();
  for (Side side : {Side::kLeft, Side::kRight}) {
    const size_t s = static_cast<size_t>(Index(side));
    posture.X_WSole[s] = ToIsometry(FootPose(x, side), x[FootIndex(side) + 2]);
    posture.ik[s] = SolveLegIk(robot.legs[s], X_BW * posture.X_WSole[s]);
    if (posture.ik[s].status != LegIkStatus::kSolved) {
      posture.reachable = false;
      continue;
    }
    posture.frames[s] = PlaceLeg(robot.legs[s], posture.ik[s].q);
    for (size_t i = 0; i < 7; ++i) {
      posture.X_WLink[s][i] = posture.X_WB * posture.frames[s].X_BLink[i];
    }
  }
  return posture;
}

bool SolveJointSpeeds(const RobotModel& robot, const WalkJet& jet, Posture* posture) {
  const Eigen::Matrix3d R_BW = posture->X_WB.linear().transpose();
  const double yaw_rate = jet.first[kWaistYaw];
  const Eigen::Vector3d z{0, 0, 1};
  posture->waist_velocity << jet.first.segment<2>(kComX), jet.first[kWaistZ];
  posture->waist_velocity -= yaw_rate * robot.com_x_B * posture->X_WB.linear().col(1);
  for (Side side : {Side::kLeft, Side::kRight}) {
    const size_t s = static_cast<size_t>(Index(side));
    if (!InvertLegJacobian(robot.legs[s], posture->frames[s], &posture->jacobian_inverse[s])) {
      return false;
    }
    const int foot = FootIndex(side);
    const Eigen::Vector3d lever_W = posture->X_WSole[s].translation() - posture->X_WB.translation();
    const Eigen::Vector3d velocity_W =
        jet.first.segment<3>(foot) - posture->waist_velocity - yaw_rate * z.cross(lever_W);
    Vector6d twist;
    twist << (jet.first[foot + 3] - yaw_rate) * z, R_BW * velocity_W;
    posture->speeds[s] = posture->jacobian_inverse[s] * twist;
  }
  return true;
}

}  // namespace halfstep
