#include "planner/scene/solid_body.h"

#include <cmath>

#include "wpg/check.h"
#include "wpg/geometry/simple_polygon.h"

namespace halfstep {
namespace {

// Whether opposite edges of four corners are parallel and neighbouring ones at right angles.
bool IsRectangle(const Eigen::Matrix2Xd& p) {
  if (p.cols() != 4) return false;
  const Eigen::Vector2d a = p.col(1) - p.col(0), b = p.col(2) - p.col(1);
  const double size = a.norm() + b.norm();
  const bool right = std::abs(a.dot(b)) <= 1e-12 * a.norm() * b.norm();
  return right && (p.col(3) - p.col(2) + a).norm() <= 1e-12 * size;
}

// Polygons along these axes [m].
Eigen::AlignedBox2d Bounds(const Eigen::Matrix2d& axes, const Eigen::Matrix2Xd& polygon) {
  const Eigen::Matrix2Xd turned = axes.transpose() * polygon;
  return {turned.rowwise().minCoeff(), turned.rowwise().maxCoeff()};
}

}  // namespace

Obstacle BodyOf(const GroundSolid& solid) {
  HALFSTEP_CHECK(solid.polygon.allFinite() && SignedArea(solid.polygon) > 0.0,
                 "the polygon of " << solid.name);
  HALFSTEP_CHECK(
      std::isfinite(solid.top) && std::isfinite(solid.bottom) && solid.bottom < solid.top,
      solid.name << " from " << solid.bottom << " m to " << solid.top << " m");
  const double height = solid.top - solid.bottom;
  Obstacle body{.name = solid.name, .shape = Box{}};
  if (IsRectangle(solid.polygon)) {
    const Eigen::Vector2d x = (solid.polygon.col(1) - solid.polygon.col(0)).normalized();
    Eigen::Matrix2d axes;
    axes << x.x(), -x.y(), x.y(), x.x();
    const Eigen::AlignedBox2d bounds = Bounds(axes, solid.polygon);
    body.shape = Box{{bounds.sizes().x(), bounds.sizes().y(), height}};
    body.X_WO.linear().topLeftCorner<2, 2>() = axes;
    body.X_WO.translation() << axes * bounds.center(), 0.5 * (solid.bottom + solid.top);
    return body;
  }
  const Eigen::Vector2d center = Bounds(Eigen::Matrix2d::Identity(), solid.polygon).center();
  const Eigen::Index n = solid.polygon.cols();
  Eigen::Matrix3Xd corners(3, 2 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector2d p = solid.polygon.col(i) - center;
    corners.col(i) << p, -0.5 * height;
    corners.col(n + i) << p, 0.5 * height;
  }
  body.shape = MakeHull(corners);
  body.X_WO.translation() << center, 0.5 * (solid.bottom + solid.top);
  return body;
}

}  // namespace halfstep
