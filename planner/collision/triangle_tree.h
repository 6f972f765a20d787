#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "planner/scene/scene.h"

namespace halfstep {

/// The triangles of a mesh in a tree of boxes along the axes of the mesh's frame. Node 0 is the
/// root.
struct TriangleTree {
  struct Node {
    Eigen::Vector3d center, half;  ///< box [m]
    int32_t left = -1;             ///< the children are nodes left and left + 1; −1: a leaf
    int32_t first = 0, count = 0;  ///< of a leaf: triangles first … first + count − 1
  };
  std::vector<Node> nodes;
  std::vector<Eigen::Matrix3d> triangles;  ///< corners in columns [m], in the order of the leaves

  TriangleTree() = default;
  /// Precondition: at least one triangle, finite vertices (std::logic_error).
  explicit TriangleTree(const TriangleMesh& mesh);
};

/// Whether a triangle (corners in columns) and the box |x| ≤ half share a point, borders included.
/// The 13 separating axes decide, and rounding errs towards true.
bool TriangleMeetsBox(const Eigen::Matrix3d& corners, const Eigen::Vector3d& half);

}  // namespace halfstep
