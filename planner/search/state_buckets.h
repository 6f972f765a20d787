#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "planner/search/step_graph.h"
#include "wpg/geometry/pose2.h"
#include "wpg/nth.h"

namespace halfstep {

/// Distance between poses of a foot seen from above [m]: that of their positions plus, `with_yaw`,
/// 0.15 m per radian between their yaws (modulo 2π).
double StateDistance(const Pose2& a, const Pose2& b, bool with_yaw);

/// Indices of states, grouped by support foot and place seen from above, to find the one nearest to
/// a pose quickly.
class StateBuckets {
 public:
  /// Made for states in `area`, in W [m]; those outside are found more slowly.
  explicit StateBuckets(const Eigen::AlignedBox2d& area);

  /// Adds a state under an index of the caller's.
  void Insert(int index, const StepState& state);
  /// Precondition: inserted before with this state (std::logic_error).
  void Remove(int index, const StepState& state);
  /// Index of the nearest state supported by `support`, the first inserted among equals;
  /// −1: there is none.
  int FindNearest(const Pose2& X_W, Side support, bool with_yaw) const;
  /// States supported by that foot.
  int size(Side support) const { return Nth(sizes_, Index(support)); }

 private:
  struct Entry {
    int index;
    Pose2 X_WS;
  };
  Eigen::Vector2i CellOf(const Pose2& X_W) const;  // clamped to the area
  double Gap(int cell, int axis, double at) const;
  std::vector<Entry>& At(const Eigen::Vector2i& cell, Side support);
  const std::vector<Entry>& At(const Eigen::Vector2i& cell, Side support) const;

  Eigen::AlignedBox2d area_;
  double edge_;
  Eigen::Vector2i count_;
  std::array<std::vector<std::vector<Entry>>, 2> cells_;
  std::array<int, 2> sizes_{0, 0};
};

}  // namespace halfstep
