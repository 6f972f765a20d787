#include "experiments/verify/foot_forces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/verify/check_rows.h"
#include "wpg/geometry/support_polygon.h"
#include "wpg/nth.h"

namespace halfstep::verify {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double FromSole(const RobotModel& robot, const Pose2& X_WF, const Vector2d& p_W) {
  const Vector2d p_F = X_WF.Inverse() * p_W, half = 0.5 * robot.sole_size;
  return (p_F - p_F.cwiseMax(-half).cwiseMin(half)).norm();
}

// How far one may go from p along u, both ways, before the polygon ends.
double WayBothWays(const SupportPolygon& polygon, const Vector2d& p, const Vector2d& u) {
  double way = std::numeric_limits<double>::infinity();
  for (int i = 0; i < polygon.size(); ++i) {
    const Vector2d a = polygon.corner(i), edge = polygon.corner((i + 1) % polygon.size()) - a;
    const double along = u.x() * edge.y() - u.y() * edge.x();
    if (std::abs(along) < 1e-9 * edge.norm() || edge.norm() < 1e-9) continue;
    const Vector2d to = a - p;
    way = std::min(way, std::abs((to.x() * edge.y() - to.y() * edge.x()) / along));
  }
  return way;
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
  const SupportPolygon polygon = PolygonOf(row, robot);
  const Vector2d zmp = momentum.Zmp(floor);
  if (!(polygon.Margin(zmp) > 0)) return std::numeric_limits<double>::infinity();
  double way = 0;
  for (int i = 0; i < polygon.size(); ++i) {
    const Vector2d edge = polygon.corner((i + 1) % polygon.size()) - polygon.corner(i);
    if (edge.norm() < 1e-9) continue;
    way = std::max(way, WayBothWays(polygon, zmp, edge.normalized()));
  }
  const Vector3d& force = momentum.floor.force;
  const double turn = momentum.floor.About(floor.Point(zmp)).z();
  return (force.head<2>().norm() + std::abs(turn) / way) / force.z();
}

}  // namespace halfstep::verify
