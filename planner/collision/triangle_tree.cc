#include "planner/collision/triangle_tree.h"

#include <Eigen/Geometry>

#include "wpg/check.h"

namespace halfstep {
namespace {

constexpr int32_t kLeaf = 4;  // triangles

}  // namespace

std::vector<Eigen::AlignedBox3d> TriangleBounds(const TriangleMesh& mesh) {
  HALFSTEP_CHECK(mesh.vertices.allFinite(), "a vertex of the mesh is not finite");
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.reserve(static_cast<size_t>(mesh.triangles.cols()));
  for (const Eigen::Vector3i& t : mesh.triangles.colwise()) {
    boxes.emplace_back(Eigen::Vector3d(mesh.vertices.col(t[0])));
    boxes.back().extend(mesh.vertices.col(t[1])).extend(mesh.vertices.col(t[2]));
  }
  return boxes;
}

TriangleTree::TriangleTree(const TriangleMesh& mesh) : BoundsTree(TriangleBounds(mesh), kLeaf) {
  HALFSTEP_CHECK(mesh.triangles.cols() > 0, "a mesh without triangles");
  triangles.resize(order.size());
  for (size_t i = 0; i < order.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      triangles[i].col(k) = mesh.vertices.col(mesh.triangles(k, order[i]));
    }
  }
}

bool TriangleMeetsBox(const Eigen::Matrix3d& corners, const Eigen::Vector3d& half) {
  const double slack = 1e-12 * (corners.cwiseAbs().maxCoeff() + half.maxCoeff());
  const Eigen::Vector3d size = half.array() + slack;
  if ((corners.rowwise().minCoeff().array() > size.array()).any() ||
      (corners.rowwise().maxCoeff().array() < -size.array()).any()) {
    return false;
  }
  const auto apart_along = [&](const Eigen::Vector3d& axis) {
    const Eigen::RowVector3d at = axis.transpose() * corners;
    const double reach = axis.cwiseAbs().dot(size) + slack * axis.lpNorm<1>();
    return at.minCoeff() > reach || at.maxCoeff() < -reach;
  };
  const Eigen::Vector3d e0 = corners.col(1) - corners.col(0), e1 = corners.col(2) - corners.col(1);
  if (apart_along(e0.cross(e1))) return false;
  const Eigen::Vector3d e2 = corners.col(0) - corners.col(2);
  for (const Eigen::Vector3d& e : {e0, e1, e2}) {
    if (apart_along({0, -e.z(), e.y()}) || apart_along({e.z(), 0, -e.x()}) ||
        apart_along({-e.y(), e.x(), 0})) {
      return false;
    }
  }
  return true;
}

}  // namespace halfstep
