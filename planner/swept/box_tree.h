#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "planner/swept/voxel_grid.h"

namespace halfstep {

/// Four boxes of cells [lower, upper) of a lattice, side by side so that they are tested together;
/// one cache line. A child is the index of a node that the box encloses, or kSolid or kAbsent.
struct alignas(64) BoxNode {
  static constexpr int32_t kSolid = -1;   ///< the box is a leaf: all of it is occupied
  static constexpr int32_t kAbsent = -2;  ///< lower > upper: meets nothing

  uint16_t lower[3][4];  ///< by axis, child
  uint16_t upper[3][4];  ///< see lower
  int32_t child[4];      ///< index of the node, kSolid or kAbsent
};
static_assert(sizeof(BoxNode) == 64);

/// A region as a union of solid, closed, axis-aligned boxes, in a tree whose nodes lie in one
/// array; node 0 is the root and children come after their parents.
struct BoxTree {
  /// Most nodes on the stack of a depth-first walk: three a level and one, of at most 85 levels.
  static constexpr int kStack = 256;

  Eigen::Vector3d origin{0, 0, 0};  ///< of the lattice [m]
  double cell = 0.01;               ///< its spacing [m]
  std::vector<BoxNode> nodes;       ///< empty: the empty region
  /// One point of each connected part of the region [m] (boxes that share a face are connected).
  std::vector<Eigen::Vector3d> parts;

  /// The occupied cells, exactly. Splits where the children's bounds leave out most; a node is
  /// solid as soon as its bounds are full.
  static BoxTree Build(const VoxelGrid& grid);

  /// Whether it is safe to walk: children come after their parents and are in range, each node is
  /// named once, the depth fits kStack, and boxes have lower ≤ upper and lie within their parents'.
  bool IsSound() const;

  /// A solid box of cells [lower, upper).
  struct CellBox {
    Eigen::Vector3i lower, upper;  ///< along x, y, z, in cells
    int64_t Cells() const {        ///< 0 when it is empty or turned round
      const Eigen::Matrix<int64_t, 3, 1> size = (upper - lower).cast<int64_t>();
      return (size.array() <= 0).any() ? 0 : size.prod();
    }
  };
  /// All solid boxes; they do not overlap.
  std::vector<CellBox> SolidBoxes() const;
  Eigen::Vector3d Corner(const Eigen::Vector3i& cells) const {  ///< [m]
    return origin + cell * cells.cast<double>();
  }

  /// Axis-aligned bounds [m]; lower > upper when empty.
  Eigen::Vector3d Lower() const;
  Eigen::Vector3d Upper() const;                  ///< see Lower
  double Volume() const;                          ///< [m³]
  bool Contains(const Eigen::Vector3d& p) const;  ///< closed boxes
};

}  // namespace halfstep
