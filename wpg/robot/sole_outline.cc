#include "wpg/robot/sole_outline.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <vector>

#include "wpg/elementary.h"
#include "wpg/geometry/planar_hull.h"
#include "wpg/geometry/support_polygon.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr double kNearFloor = 1e-3;  // [m] above the sole's plane

// The pose of the foot's link in the sole frame.
Eigen::Isometry3d FootInSole(const Leg& leg) {
  return leg.X_BSole.inverse(Eigen::Isometry) * leg.joints[5].X_BLink;
}

// Corners of the part of a body's core below `height`, in the sole frame: its low vertices, and
// where edges from them leave. Without triangles every two vertices are taken for an edge.
std::vector<Eigen::Vector2d> LowPoints(const ConvexBody& body, const Eigen::Matrix3Xd& vertices,
                                       double height) {
  std::vector<Eigen::Vector2d> low;
  for (const Eigen::Vector3d& v : vertices.colwise()) {
    if (v.z() < height) low.emplace_back(v.head<2>());
  }
  const auto cut = [&](Eigen::Index i, Eigen::Index j) {
    const Eigen::Vector3d a = vertices.col(i), b = vertices.col(j);
    if ((a.z() < height) == (b.z() < height)) return;
    const double s = (height - a.z()) / (b.z() - a.z());
    low.emplace_back(a.head<2>() + s * (b - a).head<2>());
  };
  for (const Eigen::Vector3i& t : body.triangles) {
    for (int k = 0; k < 3; ++k) cut(t[k], t[(k + 1) % 3]);
  }
  for (Eigen::Index i = 0; body.triangles.empty() && i < vertices.cols(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) cut(i, j);
  }
  return low;
}

// Of what is less than `height` above the sole's plane.
void AddBody(const ConvexBody& body, const Eigen::Isometry3d& X_SoleBody, double height,
             std::vector<Eigen::Vector2d>* points) {
  // A point of the body is a point of its core and at most `around` in the plane, and lower than
  // it by at most `below`.
  const double around = body.disc_radius + body.ball_radius;
  const double below =
      body.ball_radius + body.disc_radius * X_SoleBody.linear().row(2).head<2>().norm();
  const Eigen::Matrix3Xd vertices =
      (X_SoleBody.linear() * body.vertices).colwise() + X_SoleBody.translation();
  for (const Eigen::Vector2d& p : LowPoints(body, vertices, height + below)) {
    points->push_back(p);
    constexpr int kSides = 64;  // of a polygon around the disc of radius `around`
    for (int k = 0; around > 0 && k < kSides; ++k) {
      const double angle = 2 * std::numbers::pi * k / kSides;
      points->push_back(p + around / Cos(std::numbers::pi / kSides) *
                                Eigen::Vector2d(Cos(angle), Sin(angle)));
    }
  }
}

Eigen::Matrix2Xd OutlineBelow(const RobotModel& robot, double height) {
  const auto rectangle = SoleCorners(Pose2{}, robot.sole_size);
  std::vector<Eigen::Vector2d> points(rectangle.colwise().begin(), rectangle.colwise().end());
  for (const RobotBody& body : robot.bodies) {
    if (body.leg < 0 || body.link != 5) continue;
    AddBody(body.shape, FootInSole(Nth(robot.legs, body.leg)), height, &points);
  }
  std::vector<Eigen::Vector2d> hull(2 * points.size() + 1);
  hull.resize(PlanarHull(points, hull));
  Eigen::Matrix2Xd outline(2, static_cast<Eigen::Index>(hull.size()));
  for (size_t i = 0; i < hull.size(); ++i) outline.col(static_cast<Eigen::Index>(i)) = hull[i];
  return outline;
}

}  // namespace

Eigen::Matrix2Xd SoleOutline(const RobotModel& robot) { return OutlineBelow(robot, kNearFloor); }

Eigen::Matrix2Xd FootOutline(const RobotModel& robot) {
  return OutlineBelow(robot, std::numeric_limits<double>::infinity());
}

double DepthBelowSole(const RobotModel& robot, Side side) {
  const Eigen::Isometry3d X_SoleFoot = FootInSole(Nth(robot.legs, Index(side)));
  const Eigen::Vector3d down = -X_SoleFoot.linear().row(2).transpose();
  double depth = -std::numeric_limits<double>::infinity();
  for (const RobotBody& body : robot.bodies) {
    if (body.leg != Index(side) || body.link != 5) continue;
    depth = std::max(depth, Support(body.shape, down) - X_SoleFoot.translation().z());
  }
  return depth;
}

}  // namespace halfstep
