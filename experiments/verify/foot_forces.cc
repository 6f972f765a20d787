#include "experiments/verify/foot_forces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/verify/check_rows.h"
#include "experiments/verify/standing_soles.h"
#include "wpg/nth.h"

namespace halfstep::verify {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double FromSole(const RobotModel& robot, const Pose2& X_WF, const Vector2d& p_W) {
  const Vector2d p_F = X_WF.Inverse() * p_W, half = 0.5 * robot.sole_size;
  return (p_F - p_F.cwiseMax(-half).cwiseMin(half)).norm();
}

Vector3d PointAt(const Vector2d& p_W, double height) { return {p_W.x(), p_W.y(), height}; }

// A foot's share of the force, at a point and with the same share of the yaw moment about it.
Push ShareAt(double share, const Vector3d& at, double yaw, const Vector3d& force) {
  Push push{.force = share * force};
  push.moment = at.cross(push.force) + share * yaw * Vector3d::UnitZ();
  return push;
}

// Where soles stand at different heights.
std::array<Push, 2> ForcesBetweenLevels(const RobotModel& robot, const PlayedRow& row,
                                        const std::array<double, 2>& heights,
                                        const RobotMomentum& momentum) {
  std::array<Vector2d, 2> from_center;
  std::array<double, 2> away{};
  for (size_t s = 0; s < 2; ++s) {
    const Pose2 X_WF = row.X_WS(static_cast<int>(s));
    const Vector2d zmp = momentum.Zmp(heights[s]);
    from_center[s] = zmp - X_WF.position();
    away[s] = FromSole(robot, X_WF, zmp);
  }
  // Where both are 0 this is no number.
  const double of_right = away[0] / (away[0] + away[1]);
  const Vector2d off = (1 - of_right) * from_center[0] + of_right * from_center[1];
  std::array<Push, 2> feet;
  for (size_t s = 0; s < 2; ++s) {
    const Vector3d at = PointAt(row.X_WS(static_cast<int>(s)).position() + off, heights[s]);
    feet[s] = ShareAt(s == 1 ? of_right : 1 - of_right, at, momentum.floor.About(at).z(),
                      momentum.floor.force);
  }
  return feet;
}

// Room along u of the section of two soles at a share λ of the right one: how far two points on
// either side of where the force's line crosses it may be, with a disc of a quarter of that around.
class SectionRoom {
 public:
  SectionRoom(const RobotModel& robot, const PlayedRow& row, const std::array<double, 2>& heights,
              const RobotMomentum& momentum) {
    std::array<std::array<Vector2d, 4>, 2> corners;
    std::array<Vector2d, 2> crossed;
    for (size_t s = 0; s < 2; ++s) {
      const Pose2 X_WF = row.X_WS(static_cast<int>(s));
      const Vector2d half = 0.5 * robot.sole_size;
      corners[s] = {X_WF * half, X_WF * Vector2d(-half.x(), half.y()), X_WF * Vector2d(-half),
                    X_WF * Vector2d(half.x(), -half.y())};
      crossed[s] = momentum.Zmp(heights[s]);
    }
    for (size_t s = 0; s < 2; ++s) {
      for (size_t k = 0; k < 4; ++k) {
        const Vector2d edge = (corners[s][(k + 1) % 4] - corners[s][k]).normalized();
        Edge side{.along = edge, .inward = {-edge.y(), edge.x()}};
        for (size_t of = 0; of < 2; ++of) {
          double farthest = -std::numeric_limits<double>::infinity();  // out of the sole
          for (const Vector2d& corner : corners[of])
            farthest = std::max(farthest, -side.inward.dot(corner));
          side.depth[of] = side.inward.dot(crossed[of]) + farthest;
        }
        sides_[4 * s + k] = side;
      }
    }
  }

  // The largest room of all shares and of all edges; not positive where the line misses the soles'
  // hull. Room is concave in the share, so it is found by sections in thirds.
  double Largest() const {
    double largest = -std::numeric_limits<double>::infinity();
    for (const Edge& u : sides_) {
      double from = 0, to = 1;
      for (int k = 0; k < 70; ++k) {
        const double third = (to - from) / 3, a = from + third, b = to - third;
        (At(a, u.along) < At(b, u.along) ? from : to) = At(a, u.along) < At(b, u.along) ? a : b;
      }
      for (const double share : {0.0, 0.5 * (from + to), 1.0})
        largest = std::max(largest, At(share, u.along));
    }
    return largest;
  }

 private:
  // An edge of a sole, and how far inside along its normal the line crosses either sole's plane.
  struct Edge {
    Vector2d along{1, 0}, inward{0, 1};
    std::array<double, 2> depth{};
  };
  double At(double share, const Vector2d& u) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Edge& side : sides_) {
      const double depth = (1 - share) * side.depth[0] + share * side.depth[1];
      least = std::min(least, depth / std::max(std::abs(side.inward.dot(u)), 0.25));
    }
    return least;
  }

  std::array<Edge, 8> sides_;
};

}  // namespace

double RobotZmpMargin(const RobotModel& robot, const PlayedRow& row,
                      const RobotMomentum& momentum) {
  const StandingSoles soles(row);
  PlayedRow projected = row;
  projected.zmp = momentum.Zmp(soles.height[0]);
  if (!soles.level()) {
    const Vector3d& force = momentum.floor.force;
    const double lower = soles.height[0] - soles.height[1];
    projected.soles[1].head<2>() += lower / force.z() * force.head<2>();
  }
  return ZmpMargin(projected, robot);
}

std::array<Push, 2> FootForces(const RobotModel& robot, const PlayedRow& row,
                               const RobotMomentum& momentum) {
  std::array<Push, 2> feet;
  if (row.support != Support::kBoth) {
    Nth(feet, row.support) = momentum.floor;
    return feet;
  }
  const StandingSoles standing(row);
  if (!standing.level()) return ForcesBetweenLevels(robot, row, standing.height, momentum);
  const double height = standing.height[0];
  const Vector2d zmp = momentum.Zmp(height);
  const std::array<Pose2, 2> soles = {row.X_WS(0), row.X_WS(1)};
  const std::array<double, 2> away = {FromSole(robot, soles[0], zmp),
                                      FromSole(robot, soles[1], zmp)};
  const double sum = away[0] + away[1];
  const std::array<double, 2> shares = {sum > 0 ? away[1] / sum : 0.5,
                                        sum > 0 ? away[0] / sum : 0.5};
  const Vector2d off = zmp - shares[0] * soles[0].position() - shares[1] * soles[1].position();
  const double turn = momentum.floor.About(PointAt(zmp, height)).z();
  for (size_t s = 0; s < 2; ++s) {
    const Vector3d at = PointAt(soles[s].position() + off, height);
    const Vector3d& force = momentum.floor.force;
    // The yaw moment of the robot's ZMP, seen from this foot's.
    const double yaw = turn + (PointAt(zmp, height) - at).cross(force).z();
    feet[s] = ShareAt(shares[s], at, yaw, force);
  }
  return feet;
}

std::array<Vector6d, 2> JointTorques(const RobotModel& robot, const PlayedRow& row,
                                     const RobotMomentum& momentum) {
  const std::array<Push, 2> feet = FootForces(robot, row, momentum);
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

double FrictionNeeded(const RobotModel& robot, const PlayedRow& row,
                      const RobotMomentum& momentum) {
  const StandingSoles soles(row);
  const Vector3d& force = momentum.floor.force;
  const Vector2d zmp = momentum.Zmp(soles.height[0]);
  double room = 0;
  if (soles.level()) {
    const SolePolygon polygon = PolygonOf(row, robot);
    room = polygon.Margin(zmp) > 0 ? polygon.LongestWay(zmp) : 0;
  } else {
    room = SectionRoom(robot, row, soles.height, momentum).Largest();
  }
  if (!(room > 0)) return std::numeric_limits<double>::infinity();
  // The same about every point of the line along the force.
  const double turn = momentum.floor.About(PointAt(zmp, soles.height[0])).z();
  return (force.head<2>().norm() + std::abs(turn) / room) / force.z();
}

}  // namespace halfstep::verify
