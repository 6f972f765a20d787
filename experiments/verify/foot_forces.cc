#include "experiments/verify/foot_forces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/verify/check_rows.h"
#include "wpg/nth.h"

namespace halfstep::verify {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double FromSole(const RobotModel& robot, const Pose2& X_WF, const Vector2d& p_W) {
  const Vector2d p_F = X_WF.Inverse() * p_W, half = 0.5 * robot.sole_size;
  return (p_F - p_F.cwiseMax(-half).cwiseMin(half)).norm();
}

}  // namespace

std::array<Push, 2> FootForces(const RobotModel& robot, const PlayedRow& row,
                               const RobotMomentum& momentum, const FlatFloor& floor) {
  std::array<Push, 2> feet;
  if (row.support != Support::kBoth) {
    Nth(feet, row.support) = momentum.floor;
    return feet;
  }
  const Vector2d zmp = momentum.Zmp(floor);
  const std::array<Pose2, 2> soles = {row.X_WS(0), row.X_WS(1)};
  const std::array<double, 2> away = {FromSole(robot, soles[0], zmp),
                                      FromSole(robot, soles[1], zmp)};
  const double sum = away[0] + away[1];
  const std::array<double, 2> shares = {sum > 0 ? away[1] / sum : 0.5,
                                        sum > 0 ? away[0] / sum : 0.5};
  const Vector2d off = zmp - shares[0] * soles[0].position() - shares[1] * soles[1].position();
  const double turn = momentum.floor.About(floor.Point(zmp)).z();
  for (size_t s = 0; s < 2; ++s) {
    const Vector3d at = floor.Point(soles[s].position() + off);
    const Vector3d& force = momentum.floor.force;
    // The yaw moment of the robot's ZMP, seen from this foot's.
    const double yaw = turn + (floor.Point(zmp) - at).cross(force).z();
    feet[s].force = shares[s] * force;
    feet[s].moment = at.cross(feet[s].force) + shares[s] * yaw * Vector3d::UnitZ();
  }
  return feet;
}

std::array<Vector6d, 2> JointTorques(const RobotModel& robot, const PlayedRow& row,
                                     const RobotMomentum& momentum, const FlatFloor& floor) {
  const std::array<Push, 2> feet = FootForces(robot, row, momentum, floor);
  std::array<Vector6d, 2> torques;
  for (size_t s = 0; s < 2; ++s) {
    for (size_t j = 0; j < 6; ++j) {
      const Vector3d& point = momentum.points[s][j];
      Vector3d moment = -feet[s].About(point);
      for (size_t k = j; k < 6; ++k) moment += momentum.links[s][k].About(point);
      torques[s][static_cast<Eigen::Index>(j)] = momentum.axes[s][j].dot(moment);
    }
  }
  return torques;
}

double FrictionNeeded(const RobotModel& robot, const PlayedRow& row, const RobotMomentum& momentum,
                      const FlatFloor& floor) {
  const SolePolygon polygon = PolygonOf(row, robot);
  const Vector2d zmp = momentum.Zmp(floor);
  if (!(polygon.Margin(zmp) > 0)) return std::numeric_limits<double>::infinity();
  const Vector3d& force = momentum.floor.force;
  const double turn = momentum.floor.About(floor.Point(zmp)).z();
  return (force.head<2>().norm() + std::abs(turn) / polygon.LongestWay(zmp)) / force.z();
}

}  // namespace halfstep::verify
