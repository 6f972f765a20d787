#pragma once

#include <Eigen/Core>
#include <string>

namespace halfstep {

/// Signed area [m²] of a polygon (2×n vertices in order): positive when counter-clockwise.
double SignedArea(const Eigen::Matrix2Xd& vertices);

/// What keeps the vertices (2×n [m]) from being a simple polygon of at least 1 mm² (fewer than
/// three, two that coincide, edges that cross or touch, hardly any area), or "".
std::string WhyNotSimple(const Eigen::Matrix2Xd& vertices);

/// Whether two simple polygons (2×n, 2×m) share a point; touching counts.
bool PolygonsTouch(const Eigen::Matrix2Xd& a, const Eigen::Matrix2Xd& b);

/// Distance of two simple polygons (2×n, 2×m) [m]: exact but for rounding when they are apart. When
/// they share a point it is negative: minus how deep a corner of one lies in the other, at most
/// −1e-9 where they only touch.
double PolygonDistance(const Eigen::Matrix2Xd& a, const Eigen::Matrix2Xd& b);

}  // namespace halfstep
