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
