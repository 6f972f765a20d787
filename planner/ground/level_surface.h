#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>

namespace halfstep {

/// The top of an upright prism, on which soles may stand.
struct LevelSurface {
  std::string name;          ///< unique in its scene
  Eigen::Matrix2Xd polygon;  ///< seen from above, in W: convex, counter-clockwise (2×n) [m]
  double height = 0.0;       ///< z of the top [m]
  double bottom = 0.0;       ///< z of the prism's lower side [m], below the top
  bool bears = true;         ///< whether soles may stand on it; if not, it is only in the way
};

/// The number of a length in whole nanometres, nearest to `length` [m]. Levels are equal when these
/// numbers of their heights are, so that 3 · 0.15 m and 0.45 m are one level: each is the double
/// nearest to the decimal.
inline double WholeNanometres(double length) { return std::round(length * 1e9) / 1e9; }

/// The same of points, in columns.
inline Eigen::Matrix2Xd WholeNanometres(const Eigen::Matrix2Xd& points) {
  return points.unaryExpr([](double x) { return WholeNanometres(x); });
}

/// The corners of a simple counter-clockwise polygon, in whole nanometres, without those that lie
/// on the line between their neighbours (within 2 nm).
Eigen::Matrix2Xd CornersOf(const Eigen::Matrix2Xd& polygon);

/// Why the corners (CornersOf) are no convex polygon of at least 1 mm²; "" when they are one.
std::string WhyNotConvex(const Eigen::Matrix2Xd& corners);

}  // namespace halfstep
