#include "planner/ground/level_surface.h"

#include <vector>

#include "wpg/files/text.h"
#include "wpg/geometry/simple_polygon.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr double kStraight = 2e-9;  // [m]

// How far b lies to the right of the line from a to c [m]: positive at a corner that turns left.
double Bulge(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const Eigen::Vector2d along = c - a, to = b - a;
  return (along.y() * to.x() - along.x() * to.y()) / along.norm();
}

}  // namespace

Eigen::Matrix2Xd CornersOf(const Eigen::Matrix2Xd& polygon) {
  const Eigen::Matrix2Xd rounded = WholeNanometres(polygon);
  std::vector<Eigen::Vector2d> corners;
  for (const Eigen::Vector2d& corner : rounded.colwise()) corners.push_back(corner);
  for (size_t i = 0; i < corners.size() && corners.size() > 3;) {
    const size_t n = corners.size();
    const Eigen::Vector2d &before = corners[(i + n - 1) % n], &after = corners[(i + 1) % n];
    // A neighbour at the same place: there is no line between them.
    const bool same = before == corners[i];
    if (same || (before != after && std::abs(Bulge(before, corners[i], after)) <= kStraight)) {
      corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(i));
      if (i > 0) --i;
    } else {
      ++i;
    }
  }
  Eigen::Matrix2Xd kept(2, static_cast<Eigen::Index>(corners.size()));
  for (Eigen::Index i = 0; i < kept.cols(); ++i) kept.col(i) = Nth(corners, i);
  return kept;
}

std::string WhyNotConvex(const Eigen::Matrix2Xd& corners) {
  const std::string mistake = WhyNotSimple(corners);
  if (!mistake.empty()) return mistake;
  const Eigen::Index n = corners.cols();
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector2d before = corners.col((i + n - 1) % n), after = corners.col((i + 1) % n);
    if (!(Bulge(before, corners.col(i), after) > kStraight)) {
      return Formatted("the corner at (%.6g, %.6g) points inwards", corners(0, i), corners(1, i));
    }
  }
  return "";
}

}  // namespace halfstep
