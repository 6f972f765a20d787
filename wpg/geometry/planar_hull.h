#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <span>

namespace halfstep {

/// Convex hull in the plane by the monotone chain: sorts `points` (n ≥ 1), writes the corners to
/// `hull` (room for 2n + 1), counter-clockwise, and returns their number. Points on an edge are no
/// corners. Source: [Andrew1979].
inline size_t PlanarHull(std::span<Eigen::Vector2d> points, std::span<Eigen::Vector2d> hull) {
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  size_t n = 0;
  const auto add = [&](const Eigen::Vector2d& p, size_t base) {
    while (n >= base + 2) {
      const Eigen::Vector2d last = hull[n - 1] - hull[n - 2], next = p - hull[n - 2];
      if (last.x() * next.y() - last.y() * next.x() > 0.0) break;
      --n;
    }
    hull[n++] = p;
  };
  for (const Eigen::Vector2d& p : points) add(p, 0);
  const size_t lower = n - 1;
  for (size_t i = points.size() - 1; i-- > 0;) add(points[i], lower);
  return std::max<size_t>(n - 1, 1);  // the last point is the first again
}

}  // namespace halfstep
