#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "planner/scene/scene.h"
#include "wpg/geometry/convex_body.h"

namespace halfstep {

/// Distances by trying every pair of features: slow, simple, and independent of the library.

inline double PointSegment(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                           const Eigen::Vector3d& b) {
  const Eigen::Vector3d ab = b - a;
  const double t = std::clamp(ab.dot(p - a) / ab.squaredNorm(), 0.0, 1.0);
  return (a + t * ab - p).norm();
}

inline double SegmentSegment(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                             const Eigen::Vector3d& c, const Eigen::Vector3d& d) {
  double best = std::min(
      {PointSegment(a, c, d), PointSegment(b, c, d), PointSegment(c, a, b), PointSegment(d, a, b)});
  const Eigen::Vector3d u = b - a, v = d - c, n = u.cross(v);
  if (n.squaredNorm() < 1e-20 * u.squaredNorm() * v.squaredNorm()) return best;
  const Eigen::Vector3d w = c - a;
  const double s = w.cross(v).dot(n) / n.squaredNorm(), t = w.cross(u).dot(n) / n.squaredNorm();
  if (s > 0 && s < 1 && t > 0 && t < 1) best = std::min(best, std::abs(w.dot(n)) / n.norm());
  return best;
}

/// Distance of a point from the plane of a triangle where it projects into it, else infinity.
inline double PointFace(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                        const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d n = (b - a).cross(c - a);
  const bool inside = n.dot((b - a).cross(p - a)) >= 0 && n.dot((c - b).cross(p - b)) >= 0 &&
                      n.dot((a - c).cross(p - c)) >= 0;
  return inside && n.norm() > 0 ? std::abs(n.dot(p - a)) / n.norm()
                                : std::numeric_limits<double>::infinity();
}

/// Distance of two triangles that do not intersect.
inline double TriangleTriangle(const Eigen::Matrix3d& s, const Eigen::Matrix3d& t) {
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    best = std::min(best, PointFace(s.col(i), t.col(0), t.col(1), t.col(2)));
    best = std::min(best, PointFace(t.col(i), s.col(0), s.col(1), s.col(2)));
    for (int j = 0; j < 3; ++j) {
      best = std::min(best,
                      SegmentSegment(s.col(i), s.col((i + 1) % 3), t.col(j), t.col((j + 1) % 3)));
    }
  }
  return best;
}

inline std::vector<Eigen::Matrix3d> Triangles(const ConvexBody& body, const Eigen::Isometry3d& X) {
  std::vector<Eigen::Matrix3d> triangles;
  for (const Eigen::Vector3i& t : body.triangles) {
    Eigen::Matrix3d corners;
    for (int i = 0; i < 3; ++i) corners.col(i) = X * Eigen::Vector3d(body.vertices.col(t[i]));
    triangles.push_back(corners);
  }
  return triangles;
}

inline std::vector<Eigen::Matrix3d> Triangles(const TriangleMesh& mesh,
                                              const Eigen::Isometry3d& X) {
  std::vector<Eigen::Matrix3d> triangles;
  for (const Eigen::Vector3i& t : mesh.triangles.colwise()) {
    Eigen::Matrix3d corners;
    for (int i = 0; i < 3; ++i) corners.col(i) = X * Eigen::Vector3d(mesh.vertices.col(t[i]));
    triangles.push_back(corners);
  }
  return triangles;
}

/// Distance of two surfaces that do not intersect.
inline double SurfaceDistance(const std::vector<Eigen::Matrix3d>& a,
                              const std::vector<Eigen::Matrix3d>& b) {
  double best = std::numeric_limits<double>::infinity();
  for (const Eigen::Matrix3d& s : a) {
    for (const Eigen::Matrix3d& t : b) best = std::min(best, TriangleTriangle(s, t));
  }
  return best;
}

/// Largest separation of two polytopes over all face normals and crossed edges: for overlapping
/// ones minus the penetration depth, for others at most the distance.
inline double WidestAxisSlab(const ConvexBody& a, const Eigen::Isometry3d& X_Wa,
                             const ConvexBody& b, const Eigen::Isometry3d& X_Wb) {
  const Eigen::Matrix3Xd in_a = (X_Wa.linear() * a.vertices).colwise() + X_Wa.translation();
  const Eigen::Matrix3Xd in_b = (X_Wb.linear() * b.vertices).colwise() + X_Wb.translation();
  double best = -std::numeric_limits<double>::infinity();
  const auto attempt = [&](Eigen::Vector3d n) {
    if (n.norm() < 1e-9) return;
    n.normalize();
    const Eigen::RowVectorXd along_a = n.transpose() * in_a, along_b = n.transpose() * in_b;
    best = std::max(
        {best, along_a.minCoeff() - along_b.maxCoeff(), along_b.minCoeff() - along_a.maxCoeff()});
  };
  std::vector<Eigen::Vector3d> edges[2];
  int body = 0;
  for (const auto& triangles : {Triangles(a, X_Wa), Triangles(b, X_Wb)}) {
    for (const Eigen::Matrix3d& t : triangles) {
      attempt((t.col(1) - t.col(0)).cross(t.col(2) - t.col(0)));
      for (int i = 0; i < 3; ++i) {
        edges[body].push_back((t.col((i + 1) % 3) - t.col(i)).normalized());
      }
    }
    ++body;
  }
  for (const Eigen::Vector3d& e : edges[0]) {
    for (const Eigen::Vector3d& f : edges[1]) attempt(e.cross(f));
  }
  return best;
}

}  // namespace halfstep
