#include "experiments/plot/thinned.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace halfstep::plot {
namespace {

using Eigen::Vector2d;

double DistanceToSegment(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const Vector2d d = b - a;
  const double length = d.squaredNorm();
  const double t = length > 0.0 ? std::clamp((p - a).dot(d) / length, 0.0, 1.0) : 0.0;
  return (p - a - t * d).norm();
}

// Marks what of points[first … last], all finite, is kept.
void Keep(const std::vector<Vector2d>& points, size_t first, size_t last, double tolerance,
          std::vector<bool>* kept) {
  (*kept)[first] = (*kept)[last] = true;
  std::vector<std::pair<size_t, size_t>> open = {{first, last}};
  while (!open.empty()) {
    const auto [a, b] = open.back();
    open.pop_back();
    size_t farthest = a;
    double distance = tolerance;
    for (size_t i = a + 1; i < b; ++i) {
      const double d = DistanceToSegment(points[i], points[a], points[b]);
      if (d > distance) distance = d, farthest = i;
    }
    if (farthest == a) continue;
    (*kept)[farthest] = true;
    open.emplace_back(a, farthest);
    open.emplace_back(farthest, b);
  }
}

}  // namespace

std::vector<Vector2d> Thinned(const std::vector<Vector2d>& points, double tolerance) {
  std::vector<bool> kept(points.size(), false);
  for (size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) {
      kept[i] = true;
      continue;
    }
    size_t last = i;
    while (last + 1 < points.size() && points[last + 1].allFinite()) ++last;
    Keep(points, i, last, tolerance, &kept);
    i = last;
  }
  std::vector<Vector2d> result;
  for (size_t i = 0; i < points.size(); ++i) {
    if (kept[i]) result.push_back(points[i]);
  }
  return result;
}

}  // namespace halfstep::plot
