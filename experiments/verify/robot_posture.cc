#include "experiments/verify/robot_posture.h"

#include <cmath>

namespace halfstep::verify {
namespace {

// How far a sole may be from where it is asked to be [m], [rad].
constexpr double kReached = 1e-9;

}  // namespace

RobotPosture PostureOf(const RobotModel& robot, const WalkNumbers& x) {
  RobotPosture posture;
  const Pose2 X_WB = Pose2{x[kComX], x[kComX + 1], x[kWaistYaw]} * Pose2{-robot.com_x_B, 0, 0};
  posture.X_WB = ToIsometry(X_WB, robot.waist_height);
  for (size_t side = 0; side < 2; ++side) {
    const Eigen::Vector4d sole = x.segment<4>(SoleX(static_cast<int>(side)));
    const Eigen::Isometry3d X_BSole =
        posture.X_WB.inverse() * ToIsometry({sole[0], sole[1], sole[3]}, sole[2]);
    const auto q = AnglesOf(robot.legs[side], X_BSole);
    if (q) posture.legs[side] = PlaceLegAt(robot.legs[side], *q);
    const bool reached = q && FromSoleTo(posture.legs[side], X_BSole).norm() <= kReached;
    posture.q[side] = reached ? *q : Vector6d::Constant(std::nan(""));
    posture.reached = posture.reached && reached;
  }
  return posture;
}

}  // namespace halfstep::verify
