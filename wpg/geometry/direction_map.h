#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace halfstep {

/// For every direction the few points of a set that may be the farthest along it. The surface of a
/// cube around the origin is cut into squares; a direction belongs to the square that it meets. A
/// square's list leaves out only points that another one exceeds along all of its directions by
/// more than rounding, so the farthest point of the list is, to the last bit and among equals, the
/// one that looking at all points finds. A value that stays right only while the points do.
class DirectionMap {
 public:
  /// Of nothing: no lists.
  DirectionMap() = default;
  /// Precondition: at least one point, all finite (std::logic_error).
  explicit DirectionMap(const Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor>& points);

  /// Indices of the points that may be the farthest along `direction`, of any length, ascending.
  /// Empty when the map is, or for a direction that is zero or not finite, or nearly so.
  std::span<const int32_t> Along(const Eigen::Vector3d& direction) const;

 private:
  int squares_ = 0;               // along an edge of the cube; a power of two
  std::vector<uint32_t> starts_;  // of each square's list in `points_`, and where the last one ends
  std::vector<int32_t> points_;
};

}  // namespace halfstep
