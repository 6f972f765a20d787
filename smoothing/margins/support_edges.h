#pragma once

#include <Eigen/Core>

#include "smoothing/margins/instant.h"
#include "wpg/geometry/support_polygon.h"
#include "wpg/motion/sole_shadows.h"

namespace halfstep {

/// The edges of what supports the robot at an instant: statements about points that stay inside,
/// and how they change when the point moves and, with footsteps, the soles.
class SupportEdges {
 public:
  /// Of the soles of the instant, seen from above. It is borrowed.
  explicit SupportEdges(Instant* at) : polygon_(at->support()), at_(*at) {}
  /// Of the soles' shadows there, which are borrowed as well.
  SupportEdges(Instant* at, const SoleShadows& shadows)
      : polygon_(shadows.hull()), at_(*at), shadows_(&shadows) {}

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
  /// The gradient of Inside with respect to where the soles are, p and the force's tilt held still;
  /// with respect to p it is `inward`.
  WalkState BySoles(int i, const Eigen::Vector2d& inward, const Eigen::Vector2d& p) const;
  /// The height z such that Inside changes with the force as `inward` times the ZMP at that height
  /// does, the soles held still [m]: of the point of the soles' hull whose shadow is nearest to p.
  /// Source: wpg/README.md, "Soles at different heights".
  double HeightBeside(int i, const Eigen::Vector2d& p) const;

 private:
  // Of p along edge i, 0 at its beginning.
  double Share(int i, const Eigen::Vector2d& p) const;
  // Where a sole, or its shadow, is.
  Pose2 PlaceOf(Side side) const;
  // The sole of which, or of whose shadow, it is a corner.
  Side SoleOf(const Eigen::Vector2d& corner) const;
  // Adds the gradient of weight · corner.
  void AddCorner(const Eigen::Vector2d& corner, const Eigen::Vector2d& weight,
                 WalkState* gradient) const;

  const SupportPolygon& polygon_;
  const Instant& at_;
  const SoleShadows* shadows_ = nullptr;  // null: the soles themselves
};

}  // namespace halfstep
