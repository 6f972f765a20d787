#include "experiments/verify/sole_polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace halfstep::verify {
namespace {

using Eigen::Vector2d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Edges are longer [m], and what is more parallel [1] does not meet.
constexpr double kNothing = 1e-9;

double Cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

// The hull's lower and upper chain, counter-clockwise from the leftmost corner.
SolePolygon::SolePolygon(const std::vector<Pose2>& soles, const Vector2d& size) {
  std::vector<Vector2d> corners, hull;
  for (const Pose2& X_WS : soles) {
    for (const double x : {-0.5, 0.5}) {
      for (const double y : {-0.5, 0.5})
        corners.push_back(X_WS * Vector2d(x, y).cwiseProduct(size));
    }
  }
  std::ranges::sort(corners, [](const Vector2d& a, const Vector2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  for (const bool lower : {true, false}) {
    const size_t begin = hull.size();
    for (const Vector2d& corner : corners) {
      while (hull.size() >= begin + 2 &&
             Cross(hull.back() - hull[hull.size() - 2], corner - hull.back()) <= 0) {
        hull.pop_back();
      }
      hull.push_back(corner);
    }
    hull.pop_back();  // where the other chain begins
    if (lower) std::ranges::reverse(corners);
  }
  for (size_t i = 0; i < hull.size(); ++i) {
    const Vector2d edge = hull[(i + 1) % hull.size()] - hull[i];
    if (edge.norm() > kNothing) edges_.push_back({hull[i], edge.normalized()});
  }
}

double SolePolygon::Margin(const Vector2d& p) const {
  double margin = kInfinity;
  for (const Edge& edge : edges_) margin = std::min(margin, Cross(edge.along, p - edge.from));
  return margin;
}

double SolePolygon::LongestWay(const Vector2d& p) const {
  double longest = 0;
  for (const Edge& direction : edges_) {
    double way = kInfinity;
    for (const Edge& edge : edges_) {
      const double across = Cross(direction.along, edge.along);
      if (std::abs(across) < kNothing) continue;
      way = std::min(way, std::abs(Cross(edge.from - p, edge.along) / across));
    }
    longest = std::max(longest, way);
  }
  return longest;
}

}  // namespace halfstep::verify
