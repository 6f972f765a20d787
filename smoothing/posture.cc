#include "smoothing/posture.h"

namespace halfstep {

Posture SolvePosture(const RobotModel& robot, const WalkVector& x) {
  Posture posture;
  const Pose2 X_WC{x[kComX], x[kComY], x[kWaistYaw]};
  posture.X_WB = ToIsometry(X_WC * Pose2{-robot.com_x_B, 0.0, 0.0}, robot.waist_height);
  posture.reachable = true;
  const Eigen::Isometry3d X_BW = posture.X_WB.inverse();
  for (Side side : {Side::kLeft, Side::kRight}) {
    const size_t s = static_cast<size_t>(Index(side));
    posture.X_WSole[s] = ToIsometry(FootPose(x, side), x[FootIndex(side) + 2]);
    posture.ik[s] = SolveLegIk(robot.legs[s], X_BW * posture.X_WSole[s]);
    posture.reachable = posture.reachable && posture.ik[s].status == LegIkStatus::kSolved;
  }
  return posture;
}

bool SolveJointSpeeds(const RobotModel& robot, const WalkJet& jet, Posture* posture) {
  const Eigen::Vector3d y_W = posture->X_WB.linear().col(1);
  Eigen::Matrix<double, 8, 1> rates;
  const double yaw_rate = jet.first[kWaistYaw];
  rates.head<2>() = jet.first.segment<2>(kComX) - yaw_rate * robot.com_x_B * y_W.head<2>();
  posture->waist_velocity << rates.head<2>(), 0.0;
  rates[2] = 0.0;
  rates[3] = yaw_rate;
  for (Side side : {Side::kLeft, Side::kRight}) {
    const size_t s = static_cast<size_t>(Index(side));
    rates.tail<4>() = jet.first.segment<4>(FootIndex(side));
    Eigen::Matrix<double, 6, 8> dq;
    if (!LegIkDerivative(robot.legs[s], posture->ik[s].q, posture->X_WB, posture->X_WSole[s],
                         &dq)) {
      return false;
    }
    posture->speeds[s] = dq * rates;
  }
  return true;
}

void PlaceLinks(const RobotModel& robot, Posture* posture) {
  for (size_t s = 0; s < 2; ++s) {
    posture->frames[s] = PlaceLeg(robot.legs[s], posture->ik[s].q);
    for (size_t i = 0; i < 7; ++i) {
      posture->X_WLink[s][i] = posture->X_WB * posture->frames[s].X_BLink[i];
    }
  }
}

}  // namespace halfstep
