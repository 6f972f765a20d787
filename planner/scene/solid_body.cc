#include "planner/scene/solid_body.h"

#include <cmath>

#include "planner/scene/simple_polygon.h"
#include "wpg/check.h"

namespace halfstep {
namespace {

// Whether four corners, in order, are those of their bounds along the axes.
bool IsUprightRectangle(const Eigen::Matrix2Xd& p) {
  if (p.cols() != 4) return false;
  const bool x_first =
      p(1, 0) == p(1, 1) && p(0, 1) == p(0, 2) && p(1, 2) == p(1, 3) && p(0, 3) == p(0, 0);
  const bool y_first =
      p(0, 0) == p(0, 1) && p(1, 1) == p(1, 2) && p(0, 2) == p(0, 3) && p(1, 3) == p(1, 0);
  return x_first || y_first;
}

}  // namespace

Obstacle BodyOf(const GroundSolid& solid) {
  HALFSTEP_CHECK(solid.polygon.allFinite() && SignedArea(solid.polygon) > 0.0,
                 "the polygon of " << solid.name);
  HALFSTEP_CHECK(
      std::isfinite(solid.top) && std::isfinite(solid.bottom) && solid.bottom < solid.top,
      solid.name << " from " << solid.bottom << " m to " << solid.top << " m");
  const Eigen::Vector2d lower = solid.polygon.rowwise().minCoeff(),
                        upper = solid.polygon.rowwise().maxCoeff();
  Obstacle body{.name = solid.name, .shape = Box{}};
  body.X_WO.translation() << 0.5 * (lower + upper), 0.5 * (solid.bottom + solid.top);
  const double height = solid.top - solid.bottom;
  if (IsUprightRectangle(solid.polygon)) {
    body.shape = Box{{upper.x() - lower.x(), upper.y() - lower.y(), height}};
    return body;
  }
  const Eigen::Index n = solid.polygon.cols();
  Eigen::Matrix3Xd corners(3, 2 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector2d p = solid.polygon.col(i) - 0.5 * (lower + upper);
    corners.col(i) << p, -0.5 * height;
    corners.col(n + i) << p, 0.5 * height;
  }
  body.shape = MakeHull(corners);
  return body;
}

}  // namespace halfstep
