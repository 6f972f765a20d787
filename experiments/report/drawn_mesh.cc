#include "experiments/report/drawn_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "wpg/elementary.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr int kSides = 32;

// Points of a disc's edge, or of a ball's surface, ring by ring.
std::vector<Eigen::Vector3d> Ring(double radius, double z) {
  std::vector<Eigen::Vector3d> ring;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kSides;
    ring.emplace_back(radius * Cos(angle), radius * Sin(angle), z);
  }
  return ring;
}

std::vector<Eigen::Vector3d> Ball(double radius) {
  std::vector<Eigen::Vector3d> points = {{0, 0, radius}, {0, 0, -radius}};
  constexpr int kRings = kSides / 2;
  for (int i = 1; i < kRings; ++i) {
    const double latitude = std::numbers::pi * (static_cast<double>(i) / kRings - 0.5);
    for (const Eigen::Vector3d& p : Ring(radius * Cos(latitude), radius * Sin(latitude))) {
      points.push_back(p);
    }
  }
  return points;
}

std::vector<Eigen::Vector3d> Sum(const std::vector<Eigen::Vector3d>& a,
                                 const std::vector<Eigen::Vector3d>& b) {
  std::vector<Eigen::Vector3d> sum;
  for (const Eigen::Vector3d& p : a) {
    for (const Eigen::Vector3d& q : b) sum.emplace_back(p + q);
  }
  return sum;
}

// The faces of a hull; with a ball, each corner is moved outward by its radius, so that the picture
// has no more corners than the hull.
TriangleMesh GrownFaces(const ConvexBody& hull) {
  constexpr double kUnseen = 1e-6;  // [m]: the ball stands for rounding
  TriangleMesh mesh = FacesOf(hull);
  if (hull.ball_radius < kUnseen) return mesh;
  Eigen::Matrix3Xd outward = Eigen::Matrix3Xd::Zero(3, mesh.vertices.cols());
  for (const Eigen::Vector3i& t : hull.triangles) {
    const Eigen::Vector3d a = mesh.vertices.col(t[0]), b = mesh.vertices.col(t[1]),
                          c = mesh.vertices.col(t[2]);
    for (const int corner : t) outward.col(corner) += (b - a).cross(c - a).normalized();
  }
  mesh.vertices += hull.ball_radius * outward.colwise().normalized();
  return mesh;
}

// The mesh with vertices in the same cell of a lattice joined in their first one.
TriangleMesh Joined(const TriangleMesh& mesh, double cell) {
  std::map<std::array<long, 3>, int> cells;
  std::vector<int> vertex_of(static_cast<size_t>(mesh.vertices.cols()));
  std::vector<Eigen::Vector3d> vertices;
  for (Eigen::Index i = 0; i < mesh.vertices.cols(); ++i) {
    std::array<long, 3> key{};
    for (int k = 0; k < 3; ++k) {
      Nth(key, k) = std::lround(mesh.vertices(k, i) / cell);
    }
    const auto [entry, is_new] = cells.emplace(key, static_cast<int>(vertices.size()));
    if (is_new) vertices.emplace_back(mesh.vertices.col(i));
    Nth(vertex_of, i) = entry->second;
  }
  std::vector<Eigen::Vector3i> triangles;
  for (Eigen::Index i = 0; i < mesh.triangles.cols(); ++i) {
    const Eigen::Vector3i t =
        mesh.triangles.col(i).unaryExpr([&](int vertex) { return Nth(vertex_of, vertex); });
    if (t.x() != t.y() && t.y() != t.z() && t.z() != t.x()) triangles.push_back(t);
  }
  TriangleMesh joined;
  joined.vertices = Eigen::Map<const Eigen::Matrix3Xd>(vertices.front().data(), 3,
                                                       static_cast<Eigen::Index>(vertices.size()));
  joined.triangles.resize(3, static_cast<Eigen::Index>(triangles.size()));
  for (size_t i = 0; i < triangles.size(); ++i) {
    joined.triangles.col(static_cast<Eigen::Index>(i)) = triangles[i];
  }
  return joined;
}

}  // namespace

TriangleMesh DrawnMesh(const ConvexBody& body) {
  if (body.disc_radius == 0.0 && (!body.triangles.empty() || body.ball_radius == 0.0)) {
    return GrownFaces(body);
  }
  std::vector<Eigen::Vector3d> points;
  for (const auto& vertex : body.vertices.colwise()) points.emplace_back(vertex);
  if (body.disc_radius > 0.0) points = Sum(points, Ring(body.disc_radius, 0.0));
  if (body.ball_radius > 0.0) points = Sum(points, Ball(body.ball_radius));
  Eigen::Matrix3Xd columns(3, static_cast<Eigen::Index>(points.size()));
  for (size_t i = 0; i < points.size(); ++i) columns.col(static_cast<Eigen::Index>(i)) = points[i];
  return FacesOf(MakeHull(columns));
}

TriangleMesh Coarsened(const TriangleMesh& mesh, int most) {
  if (mesh.triangles.cols() <= most) return mesh;
  const Eigen::Vector3d size =
      mesh.vertices.rowwise().maxCoeff() - mesh.vertices.rowwise().minCoeff();
  for (double cell = std::max(size.maxCoeff() / 256.0, 1e-6);; cell *= 1.25) {
    const TriangleMesh joined = Joined(mesh, cell);
    if (joined.triangles.cols() <= most) return joined;
  }
}

}  // namespace halfstep
