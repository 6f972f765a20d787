#include "experiments/verify/robot_posture.h"

#include <algorithm>
#include <cmath>

#include "wpg/nth.h"

namespace halfstep::verify {
namespace {

// How far a sole may be from where it is asked to be [m], [rad].
constexpr double kReached = 1e-9;

}  // namespace

RobotPosture PostureOf(const RobotModel& robot, const WalkNumbers& x,
                       const std::array<Vector6d, 2>* near) {
  RobotPosture posture;
  const Pose2 X_WB = Pose2{x[kComX], x[kComX + 1], x[kWaistYaw]} * Pose2{-robot.com_x_B, 0, 0};
  posture.X_WB = ToIsometry(X_WB, robot.waist_height + x[kWaistZ]);
  for (size_t side = 0; side < 2; ++side) {
    const Eigen::Vector4d sole = x.segment<4>(SoleX(static_cast<int>(side)));
    const Eigen::Isometry3d X_BSole =
        posture.X_WB.inverse() * ToIsometry({sole[0], sole[1], sole[3]}, sole[2]);
    const auto q = AnglesOf(robot.legs[side], X_BSole, near == nullptr ? nullptr : &(*near)[side]);
    if (q) posture.legs[side] = PlaceLegAt(robot.legs[side], *q);
    const bool reached = q && FromSoleTo(posture.legs[side], X_BSole).norm() <= kReached;
    posture.q[side] = reached ? *q : Vector6d::Constant(std::nan(""));
    posture.reached = posture.reached && reached;
  }
  return posture;
}

std::array<RobotPosture, 9> PosturesAround(const RobotModel& robot, const WalkInstant& at,
                                           double step, const std::array<Vector6d, 2>& near) {
  constexpr int kMiddle = 4;
  std::array<RobotPosture, 9> postures;
  postures[kMiddle] = PostureOf(robot, at.value, &near);
  for (const int sign : {1, -1}) {
    for (int k = 1; k <= kMiddle; ++k) {
      // From those next to it, of which beyond the middle there are more on the way back.
      const int known = sign > 0 ? std::min(k, 3) : 3;
      const auto q = [&](int back, size_t side) -> const Vector6d& {
        return Nth(postures, kMiddle + sign * (k - back)).q[side];
      };
      std::array<Vector6d, 2> onwards;
      for (size_t side = 0; side < 2; ++side) {
        onwards[side] = q(1, side);
        if (known == 2) onwards[side] += q(1, side) - q(2, side);
        if (known == 3) onwards[side] += 2 * q(1, side) - 3 * q(2, side) + q(3, side);
      }
      const double t = sign * k * step;
      Nth(postures, kMiddle + sign * k) =
          PostureOf(robot, at.value + t * at.first + 0.5 * t * t * at.second, &onwards);
    }
  }
  return postures;
}

}  // namespace halfstep::verify
