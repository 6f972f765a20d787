#pragma once

#include <Eigen/Core>
#include <string>

namespace halfstep {

/// Signed area [m²] of a polygon (2×n vertices in order): positive when counter-clockwise.
double SignedArea(const Eigen::Matrix2Xd& vertices);

/// Why the vertices (2×n [m]) are no simple polygon of at least 1 mm²: there are fewer than three,
/// two coincide, edges cross or touch, or the area is smaller. "" when they are one.
std::string WhyNotSimple(const Eigen::Matrix2Xd& vertices);

/// Whether two simple polygons (2×n, 2×m) share a point; touching counts.
bool PolygonsTouch(const Eigen::Matrix2Xd& a, const Eigen::Matrix2Xd& b);

/// Distance of two simple polygons (2×n, 2×m) [m]. It is exact but for rounding when they are
/// apart. When they share a point it is negative: minus the depth of the corner that lies deepest
/// in the other polygon, and −1e-9 where they only touch.
double PolygonDistance(const Eigen::Matrix2Xd& a, const Eigen::Matrix2Xd& b);

}  // namespace halfstep
