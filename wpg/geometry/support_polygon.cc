#include "wpg/geometry/support_polygon.h"

#include <limits>

#include "wpg/geometry/planar_hull.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

Eigen::Matrix<double, 2, 4> SoleCorners(const Pose2& X_WS, const Eigen::Vector2d& sole_size) {
  const double x = 0.5 * sole_size.x(), y = 0.5 * sole_size.y();
  Eigen::Matrix<double, 2, 4> corners;
  corners << x, -x, -x, x, y, y, -y, -y;
  return (X_WS.rotation() * corners).colwise() + X_WS.position();
}

Side SoleWithCorner(const std::array<Pose2, 2>& soles, const Eigen::Vector2d& sole_size,
                    const Eigen::Vector2d& corner) {
  double nearest = std::numeric_limits<double>::infinity();
  Side of = Side::kLeft;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const auto corners = SoleCorners(Nth(soles, Index(side)), sole_size);
    const double distance = (corners.colwise() - corner).colwise().norm().minCoeff();
    if (!(distance < nearest)) continue;
    nearest = distance;
    of = side;
  }
  return of;
}

SupportPolygon::SupportPolygon(const Pose2& X_WS, const Eigen::Vector2d& sole_size) : size_(4) {
  corners_.leftCols<4>() = SoleCorners(X_WS, sole_size);
}

SupportPolygon::SupportPolygon(const Pose2& X_WL, const Pose2& X_WR,
                               const Eigen::Vector2d& sole_size) {
  std::array<Eigen::Vector2d, 8> points;
  const auto left = SoleCorners(X_WL, sole_size), right = SoleCorners(X_WR, sole_size);
  for (int i = 0; i < 4; ++i) {
    Nth(points, i) = left.col(i);
    Nth(points, i + 4) = right.col(i);
  }
  std::array<Eigen::Vector2d, 17> hull;
  size_ = static_cast<int>(PlanarHull(points, hull));
  for (int i = 0; i < size_; ++i) corners_.col(i) = Nth(hull, i);
}

// The edges of both, in the order of their directions: each of the left sole's is followed by that
// of the right one which is turned against it by 0 to 90°.
SupportPolygon SupportPolygon::Section(const Pose2& X_WL, const Pose2& X_WR,
                                       const Eigen::Vector2d& sole_size, double share) {
  const auto left = SoleCorners(X_WL, sole_size), right = SoleCorners(X_WR, sole_size);
  const Eigen::Matrix2d of_left = X_WL.rotation(), of_right = X_WR.rotation();
  // Edge k of a sole points along −x, −y, x, y of its own.
  const std::array<Eigen::Vector2d, 4> edges = {-of_right.col(0), -of_right.col(1), of_right.col(0),
                                                of_right.col(1)};
  const Eigen::Vector2d between = -(of_left.col(0) + of_left.col(1));
  Eigen::Index first = 0;
  for (Eigen::Index k = 1; k < 4; ++k) {
    if (Nth(edges, k).dot(between) > Nth(edges, first).dot(between)) first = k;
  }
  SupportPolygon section;
  section.size_ = 8;
  for (Eigen::Index k = 0; k < 4; ++k) {
    const Eigen::Vector2d of_right_sole = share * right.col((k + first) % 4);
    section.corners_.col(2 * k) = (1.0 - share) * left.col(k) + of_right_sole;
    section.corners_.col(2 * k + 1) = (1.0 - share) * left.col((k + 1) % 4) + of_right_sole;
  }
  return section;
}

double SupportPolygon::Margin(const Eigen::Vector2d& p_W) const {
  double margin = std::numeric_limits<double>::infinity();
  for (int i = 0; i < size_; ++i) {
    const Eigen::Vector2d a = corners_.col(i), b = corners_.col((i + 1) % size_);
    const Eigen::Vector2d edge = b - a;
    const double length = edge.norm();
    if (length > 1e-9) margin = std::min(margin, Cross(edge, p_W - a) / length);
  }
  return margin;
}

}  // namespace halfstep
