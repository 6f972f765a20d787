#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "planner/collision/triangle_tree.h"

namespace halfstep {

/// The winding number of a mesh (planner/collision/mesh_interior.h), found without a look at each
/// triangle. Seen from outside the box of a node of the tree, the node's triangles wind as much as
/// a cap over their border, and a closed part has no border. Exact up to rounding. Source:
/// [Jacobson2013] §4.2.
class MeshWinding {
 public:
  MeshWinding() = default;
  explicit MeshWinding(const TriangleTree& tree);  ///< `tree` is borrowed.

  /// The winding number around a point of the mesh's frame [m] that is not on the surface. `tree`
  /// is that of the constructor.
  double At(const TriangleTree& tree, const Eigen::Vector3d& point) const;

 private:
  using Corner = std::array<double, 3>;
  struct Edge {
    int32_t from, to, times;  // corners; how often it is run through
  };
  struct Border {
    int32_t first = 0, count = -1;  // of the edges; −1: none kept, ask the children
  };
  std::vector<Corner> corners_;
  std::vector<Edge> edges_;
  std::vector<Border> borders_;  // by node
};

}  // namespace halfstep
