#include "wpg/geometry/simple_polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace halfstep {
namespace {

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// −1, 0, +1: on which side of the line from a to b the point c lies.
int SideOf(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const double cross = Cross(b - a, c - a);
  return cross > 0.0 ? 1 : cross < 0.0 ? -1 : 0;
}

bool InBoundsOf(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (c.array() >= a.cwiseMin(b).array()).all() && (c.array() <= a.cwiseMax(b).array()).all();
}

// Whether the closed segments ab and cd share a point.
bool Meet(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
          const Eigen::Vector2d& d) {
  const int abc = SideOf(a, b, c), abd = SideOf(a, b, d);
  const int cda = SideOf(c, d, a), cdb = SideOf(c, d, b);
  if (abc != abd && cda != cdb) return true;
  return (abc == 0 && InBoundsOf(a, b, c)) || (abd == 0 && InBoundsOf(a, b, d)) ||
         (cda == 0 && InBoundsOf(c, d, a)) || (cdb == 0 && InBoundsOf(c, d, b));
}

// Parity of the crossings of a ray from p along +x; p is not on the boundary.
bool Contains(const Eigen::Matrix2Xd& polygon, const Eigen::Vector2d& p) {
  bool inside = false;
  for (Eigen::Index i = 0; i < polygon.cols(); ++i) {
    const Eigen::Vector2d a = polygon.col(i), b = polygon.col((i + 1) % polygon.cols());
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) {
      inside = !inside;
    }
  }
  return inside;
}

// Distance of p from the boundary of a polygon.
double FromBoundary(const Eigen::Matrix2Xd& polygon, const Eigen::Vector2d& p) {
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < polygon.cols(); ++i) {
    const Eigen::Vector2d a = polygon.col(i);
    const Eigen::Vector2d edge = polygon.col((i + 1) % polygon.cols()) - a;
    const double along = std::clamp(edge.dot(p - a) / edge.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (p - a - along * edge).norm());
  }
  return least;
}

// How deep the deepest corner of `a` lies in `b`; 0: none does.
double Depth(const Eigen::Matrix2Xd& a, const Eigen::Matrix2Xd& b) {
  double deepest = 0.0;
  for (Eigen::Index i = 0; i < a.cols(); ++i) {
    if (Contains(b, a.col(i))) deepest = std::max(deepest, FromBoundary(b, a.col(i)));
  }
  return deepest;
}

std::string Edge(Eigen::Index i, Eigen::Index n) {
  return std::to_string(i) + "–" + std::to_string((i + 1) % n);
}

}  // namespace

double SignedArea(const Eigen::Matrix2Xd& vertices) {
  double twice_area = 0.0;
  for (Eigen::Index i = 1; i + 1 < vertices.cols(); ++i) {
    twice_area += Cross(vertices.col(i) - vertices.col(0), vertices.col(i + 1) - vertices.col(0));
  }
  return 0.5 * twice_area;
}

std::string WhyNotSimple(const Eigen::Matrix2Xd& vertices) {
  constexpr double kLeastArea = 1e-6;
  const Eigen::Index n = vertices.cols();
  if (n < 3) return "fewer than three vertices";
  for (Eigen::Index i = 0; i < n; ++i) {
    if (vertices.col(i) == vertices.col((i + 1) % n)) {
      return "vertices " + Edge(i, n) + " coincide";
    }
  }
  const auto vertex = [&vertices, n](Eigen::Index i) -> Eigen::Vector2d {
    return vertices.col(i % n);
  };
  for (Eigen::Index i = 0; i < n; ++i) {
    // The next edge shares a vertex: it may not fold back over this one.
    const Eigen::Vector2d edge = vertex(i + 1) - vertex(i), next = vertex(i + 2) - vertex(i + 1);
    if (Cross(edge, next) == 0.0 && edge.dot(next) < 0.0) {
      return "edge " + Edge((i + 1) % n, n) + " folds back over edge " + Edge(i, n);
    }
    for (Eigen::Index k = i + 2; k < n; ++k) {
      if (i == 0 && k == n - 1) continue;
      if (Meet(vertex(i), vertex(i + 1), vertex(k), vertex(k + 1))) {
        return "edges " + Edge(i, n) + " and " + Edge(k, n) + " meet";
      }
    }
  }
  if (std::abs(SignedArea(vertices)) < kLeastArea) return "an area of less than 1 mm²";
  return "";
}

bool PolygonsTouch(const Eigen::Matrix2Xd& a, const Eigen::Matrix2Xd& b) {
  for (Eigen::Index i = 0; i < a.cols(); ++i) {
    for (Eigen::Index j = 0; j < b.cols(); ++j) {
      if (Meet(a.col(i), a.col((i + 1) % a.cols()), b.col(j), b.col((j + 1) % b.cols()))) {
        return true;
      }
    }
  }
  // No edges meet: one contains the other, and then any of its vertices, or they are apart.
  return Contains(a, b.col(0)) || Contains(b, a.col(0));
}

double PolygonDistance(const Eigen::Matrix2Xd& a, const Eigen::Matrix2Xd& b) {
  constexpr double kTouching = 1e-9;
  if (PolygonsTouch(a, b)) return -std::max({kTouching, Depth(a, b), Depth(b, a)});
  // Edges that do not meet are nearest at an end of one of them.
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < a.cols(); ++i) least = std::min(least, FromBoundary(b, a.col(i)));
  for (Eigen::Index i = 0; i < b.cols(); ++i) least = std::min(least, FromBoundary(a, b.col(i)));
  return least;
}

}  // namespace halfstep
