#pragma once

#include <Eigen/Core>

#include "smoothing/walk/superposed_walk.h"
#include "wpg/geometry/support_polygon.h"

namespace halfstep {

/// The edges of what supports the robot at an instant: statements about points that stay inside,
/// and how they change when the point moves and, with footsteps, the soles.
class SupportEdges {
 public:
  /// Of a walk at an instant where its quantities are `x`. `sole_size`: length and width [m].
  SupportEdges(const SuperposedWalk& walk, const LocalTime& at, const WalkState& x,
               const Eigen::Vector2d& sole_size);

  const SupportPolygon& polygon() const { return polygon_; }  ///< in W
  /// Calls visit(i, inward) for each edge i with its inward unit normal, in W.
  template <typename Visit>
  void ForEach(const Visit& visit) const {
    for (int i = 0; i < polygon_.size(); ++i) {
      const Eigen::Vector2d edge = polygon_.corner((i + 1) % polygon_.size()) - polygon_.corner(i);
      if (edge.norm() < 1e-9) continue;
      visit(i, Eigen::Vector2d(-edge.y(), edge.x()).normalized());
    }
  }
  /// How far `p` [m] is inside the line of edge i, whose inward normal is `inward`.
  double Inside(int i, const Eigen::Vector2d& inward, const Eigen::Vector2d& p) const {
    return inward.dot(p - polygon_.corner(i));
  }
  /// The derivative of Inside when p moves by `dp` along a parameter, and the soles as its
  /// sensitivity says.
  double Slope(int i, const Eigen::Vector2d& inward, const Eigen::Vector2d& p,
               const Eigen::Vector2d& dp, const WalkSensitivity& along) const;

 private:
  // How a corner moves when soles do.
  Eigen::Vector2d MoveOf(const Eigen::Vector2d& corner, const WalkState& dx) const;

  SupportPolygon polygon_;
  WalkState x_;
  Eigen::Vector2d sole_size_;
};

}  // namespace halfstep
