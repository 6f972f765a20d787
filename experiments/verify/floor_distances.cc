#include "experiments/verify/floor_distances.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace halfstep::verify {
namespace {

using Eigen::Vector2d;

double Cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// Whether the segment from a to b has a point in a convex polygon given counter-clockwise: what the
// edges' half-planes leave of it.
bool Enters(const Eigen::Matrix2Xd& convex, const Vector2d& a, const Vector2d& b) {
  double from = 0, to = 1;
  for (Eigen::Index i = 0; i < convex.cols(); ++i) {
    const Vector2d corner = convex.col(i);
    const Vector2d edge = convex.col((i + 1) % convex.cols()) - corner;
    const double at_a = Cross(edge, a - corner), at_b = Cross(edge, b - corner);
    if (at_a < 0 && at_b < 0) return false;
    if (at_a < 0) from = std::max(from, at_a / (at_a - at_b));
    if (at_b < 0) to = std::min(to, at_a / (at_a - at_b));
  }
  return from <= to;
}

// Whether p is inside a simple polygon: the angles under which it sees the edges add up to a turn.
bool Surrounds(const Eigen::Matrix2Xd& polygon, const Vector2d& p) {
  double sum = 0;
  for (Eigen::Index i = 0; i < polygon.cols(); ++i) {
    const Vector2d a = polygon.col(i) - p, b = polygon.col((i + 1) % polygon.cols()) - p;
    sum += std::atan2(Cross(a, b), a.dot(b));
  }
  return std::abs(sum) > std::numbers::pi;
}

double PointToSegment(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const Vector2d along = (b - a).normalized();
  const double ahead = along.dot(p - a);
  if (ahead <= 0) return (p - a).norm();
  if (along.dot(p - b) >= 0) return (p - b).norm();
  return std::abs(Cross(along, p - a));
}

}  // namespace

double LowestPoint(const RobotBody& body, const Placement& at) {
  const Eigen::Isometry3d X = at.OfBody(body);
  double lowest = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < body.shape.vertices.cols(); ++i) {
    const Eigen::Vector3d v = body.shape.vertices.col(i);
    lowest = std::min(lowest, (X * v).z());
  }
  const Eigen::RowVector3d up = X.linear().row(2);
  return lowest - body.shape.disc_radius * up.head<2>().norm() - body.shape.ball_radius;
}

bool IsOnFoot(const RobotBody& body) { return body.leg >= 0 && body.link == 5; }

double FromArea(const RobotModel& robot, const Pose2& X_WF, const Eigen::Matrix2Xd& area) {
  const Eigen::Matrix2Xd sole = (X_WF.rotation() * robot.sole_outline).colwise() + X_WF.position();
  if (Surrounds(area, sole.col(0))) return -1;
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < area.cols(); ++i) {
    const Vector2d a = area.col(i), b = area.col((i + 1) % area.cols());
    if (Enters(sole, a, b)) return -1;
    for (Eigen::Index k = 0; k < sole.cols(); ++k) {
      const Vector2d c = sole.col(k), d = sole.col((k + 1) % sole.cols());
      least = std::min({least, PointToSegment(c, a, b), PointToSegment(a, c, d)});
    }
  }
  return least;
}

}  // namespace halfstep::verify
