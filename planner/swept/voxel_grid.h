#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <vector>

namespace halfstep {

/// A convex region {x : n_i·x ≤ offset_i}, bounded by a box that is part of the claim.
struct HalfSpaces {
  Eigen::Matrix3Xd normals;      ///< n_i (3×m)
  Eigen::VectorXd offsets;       ///< [m] (m)
  Eigen::Vector3d lower, upper;  ///< axis-aligned bounds of the region [m]
};

/// Which cells of a lattice are occupied. Cell (i, j, k) is [i, i+1] × [j, j+1] × [k, k+1] times
/// `cell`, from `origin`; all solid and closed. One bit a cell, columns along z.
class VoxelGrid {
 public:
  /// Room for everything within [lower, upper] [m]; `origin` is a multiple of `cell`.
  /// Precondition: at most 65000 cells along an axis, 2³² in all.
  VoxelGrid(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper, double cell);

  /// Occupies at least every cell that the region meets. Per column of cells the range of z is cut
  /// by each half-space where the column's rectangle leaves most. `region` shall lie in the grid.
  void Fill(const HalfSpaces& region);
  /// Occupies one cell.
  void Occupy(int i, int j, int k) {
    uint64_t* column = &words_[Word(i, j)];
    column[k / 64] |= uint64_t{1} << (k % 64);
  }

  /// Whether the cell is occupied.
  bool Occupied(int i, int j, int k) const { return (Column(i, j)[k / 64] >> (k % 64)) & 1; }
  /// The bits of column (i, j): cell k is bit k % 64 of word k / 64.
  const uint64_t* Column(int i, int j) const { return &words_[Word(i, j)]; }
  int words_per_column() const { return words_per_column_; }  ///< number of words, each of 64 cells
  const Eigen::Vector3i& size() const { return size_; }       ///< cells along x, y, z
  const Eigen::Vector3d& origin() const { return origin_; }   ///< [m]
  double cell() const { return cell_; }                       ///< edge length [m]

 private:
  size_t Word(int i, int j) const {
    return static_cast<size_t>((int64_t{i} * size_.y() + j) * words_per_column_);
  }
  // Cells from … to of a column.
  void OccupyRange(int i, int j, int from, int to) {
    uint64_t* column = &words_[Word(i, j)];
    for (int w = from / 64; w <= to / 64; ++w) {
      const int low = std::max(from - 64 * w, 0), high = std::min(to - 64 * w, 63);
      column[w] |= (~uint64_t{0} >> (63 - (high - low))) << low;
    }
  }

  double cell_;
  Eigen::Vector3d origin_;
  Eigen::Vector3i size_;
  int words_per_column_;
  std::vector<uint64_t> words_;
};

}  // namespace halfstep
