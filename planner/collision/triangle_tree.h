#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "planner/scene/shape.h"
#include "wpg/geometry/bounds_tree.h"

namespace halfstep {

/// The triangles of a mesh in a tree of boxes along the axes of the mesh's frame, at least one.
struct TriangleTree : BoundsTree {
  std::vector<Eigen::Matrix3d> triangles;  ///< corners in columns [m], in the order of the leaves

  TriangleTree() = default;
  /// Precondition: at least one triangle, finite vertices (std::logic_error).
  explicit TriangleTree(const TriangleMesh& mesh);
};

/// The bounds of each triangle of a mesh [m].
std::vector<Eigen::AlignedBox3d> TriangleBounds(const TriangleMesh& mesh);

/// Whether a triangle (corners in columns) and the box |x| ≤ half share a point, borders included.
/// The 13 separating axes decide, and rounding errs towards true.
bool TriangleMeetsBox(const Eigen::Matrix3d& corners, const Eigen::Vector3d& half);

}  // namespace halfstep
