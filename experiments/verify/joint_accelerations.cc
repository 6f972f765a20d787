#include "experiments/verify/joint_accelerations.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/verify/robot_numbers.h"
#include "experiments/verify/tolerances.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep::verify {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Of the angle here, and of those one step and more away.
constexpr std::array<double, 5> kWeights = {-205.0 / 72, 8.0 / 5, -1.0 / 5, 8.0 / 315, -1.0 / 560};

double MarginOf(const RobotModel& robot, const std::array<Vector6d, 2>& accelerations, size_t side,
                size_t joint) {
  const double size = std::abs(accelerations[side][static_cast<Eigen::Index>(joint)]);
  return std::isnan(size) ? -kInfinity : robot.legs[side].joints[joint].max_acceleration - size;
}

}  // namespace

std::array<Vector6d, 2> JointAccelerations(const DescribedWalk& walk, double t) {
  const double step = Tolerances(walk.robot()).acceleration_step;
  const std::array<RobotPosture, 9> postures =
      PosturesAround(walk.robot(), walk.At(t), step, walk.NearAngles(t));
  std::array<Vector6d, 2> sum = {Vector6d::Zero(), Vector6d::Zero()};
  for (int k = -4; k <= 4; ++k) {
    const RobotPosture& posture = Nth(postures, k + 4);
    const double weight = posture.reached ? Nth(kWeights, std::abs(k)) : std::nan("");
    for (size_t side = 0; side < 2; ++side) sum[side] += weight * posture.q[side];
  }
  for (Vector6d& of_leg : sum) of_leg /= step * step;
  return sum;
}

double JointAccelerationMargin(const DescribedWalk& walk, double t, size_t side, size_t joint) {
  return MarginOf(walk.robot(), JointAccelerations(walk, t), side, joint);
}

double LeastJointAccelerationMargin(const DescribedWalk& walk, double t) {
  double least = kInfinity;
  if (!LimitsAccelerations(walk.robot())) return least;
  const std::array<Vector6d, 2> accelerations = JointAccelerations(walk, t);
  for (size_t side = 0; side < 2; ++side) {
    for (size_t joint = 0; joint < 6; ++joint) {
      least = std::min(least, MarginOf(walk.robot(), accelerations, side, joint));
    }
  }
  return least;
}

}  // namespace halfstep::verify
