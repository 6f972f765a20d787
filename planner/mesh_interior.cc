#include "planner/mesh_interior.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <numeric>

namespace halfstep {

std::vector<Eigen::Vector3d> ComponentPoints(const TriangleMesh& mesh) {
  std::vector<int> parent(static_cast<size_t>(mesh.vertices.cols()));
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int i) {
    while (parent[static_cast<size_t>(i)] != i) {
      int& up = parent[static_cast<size_t>(i)];
      up = parent[static_cast<size_t>(up)];
      i = up;
    }
    return i;
  };
  for (const Eigen::Vector3i& t : mesh.triangles.colwise()) {
    const int first = root(t[0]);
    parent[static_cast<size_t>(root(t[1]))] = first;
    parent[static_cast<size_t>(root(t[2]))] = first;
  }
  std::vector<bool> seen(parent.size(), false);
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3i& t : mesh.triangles.colwise()) {
    const int component = root(t[0]);
    if (seen[static_cast<size_t>(component)]) continue;
    seen[static_cast<size_t>(component)] = true;
    points.push_back(mesh.vertices.col(t[0]));
  }
  return points;
}

double WindingNumber(const TriangleMesh& mesh, const Eigen::Vector3d& point) {
  double half_angles = 0;
  for (const Eigen::Vector3i& t : mesh.triangles.colwise()) {
    const Eigen::Vector3d a = mesh.vertices.col(t[0]) - point, b = mesh.vertices.col(t[1]) - point;
    const Eigen::Vector3d c = mesh.vertices.col(t[2]) - point;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    const double volume = a.dot(b.cross(c));
    const double spread = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    half_angles += std::atan2(volume, spread);
  }
  return half_angles / (2 * std::numbers::pi);
}

}  // namespace halfstep
