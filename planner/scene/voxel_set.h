#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "planner/scene/shape.h"

namespace halfstep {

/// Cubes of one lattice, solid and closed, and their surface: how point clouds and occupancy maps
/// become obstacles. Cell (i, j, k) is [i, i + 1] × [j, j + 1] × [k, k + 1] times `cell`.
class VoxelSet {
 public:
  /// Cells that a set may have, along an axis from the origin, and in all.
  static constexpr int kFarthest = (1 << 20) - 1;
  static constexpr size_t kMost = 20'000'000;  ///< cells in all

  /// `cell` > 0 [m].
  explicit VoxelSet(double cell) : cell_(cell) {}

  /// Adds cell (i, j, k). Precondition: |i|, |j|, |k| ≤ kFarthest.
  void Add(const Eigen::Vector3i& cell);
  /// Adds every cell that a ball meets, and maybe some that it misses by rounding (1e-9 of the
  /// coordinates). Returns false, and adds nothing, where that is beyond kFarthest cells.
  bool AddBall(const Eigen::Vector3d& center, double radius);
  /// Whether there are too many cells by now to go on.
  bool full() const { return keys_.size() > 2 * kMost; }

  /// Sorts the cells, each once. To be called after cells were added, before what is below.
  void Finish();
  size_t size() const { return keys_.size(); }  ///< number of cells
  bool Has(const Eigen::Vector3i& cell) const;  ///< whether the cell is in the set
  /// Whether a point [m] lies in a cell of the set; on a side between two cells that with the
  /// larger coordinates counts.
  bool Contains(const Eigen::Vector3d& point) const;
  /// The surface of their union: two triangles for each side of a cell beside none. Closed, turned
  /// outward, in metres, each corner once.
  TriangleMesh Surface() const;

 private:
  static std::uint64_t KeyOf(const Eigen::Vector3i& cell);
  static Eigen::Vector3i CellOf(std::uint64_t key);

  double cell_;
  std::vector<std::uint64_t> keys_;  // 21 bits an axis, z last
  size_t sorted_ = 0;
};

}  // namespace halfstep
