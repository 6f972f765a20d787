#pragma once

#include <Eigen/Core>

#include "smoothing/margins/instant.h"
#include "wpg/geometry/support_polygon.h"

namespace halfstep {

/// The edges of what supports the robot at an instant: statements about points that stay inside,
/// and how they change when the point moves and, with footsteps, the soles.
class SupportEdges {
 public:
  /// Of the instant, which is borrowed.
  explicit SupportEdges(Instant* at) : polygon_(at->support()), at_(*at) {}

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
  /// The gradient of Inside with respect to where the soles are, p held still; with respect to p it
  /// is `inward`.
  WalkState BySoles(int i, const Eigen::Vector2d& inward, const Eigen::Vector2d& p) const;

 private:
  // Adds the gradient of weight · corner.
  void AddCorner(const Eigen::Vector2d& corner, const Eigen::Vector2d& weight,
                 WalkState* gradient) const;

  const SupportPolygon& polygon_;
  const Instant& at_;
};

}  // namespace halfstep
