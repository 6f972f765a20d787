#pragma once

#include <Eigen/Core>
#include <array>

#include "wpg/geometry/pose2.h"
#include "wpg/geometry/support_polygon.h"

namespace halfstep {

/// Of the sections (1 − λ)L + λR of two soles at different heights, each in its plane between them,
/// the one with most room about the point p where the line of the floor's force crosses it: the
/// segment p ± ρu, and the disc of radius ρ/4 about p, lie in it, u is along an edge of a sole, and
/// no λ and u have a larger ρ. Source: wpg/README.md, "Soles at different heights".
struct SoleSection {
  /// Of the disc, for each metre of ρ. It keeps p away from the edges along u, so that a section
  /// that is held for a while stays one: with 0 that may end at once, with 1 the sole's length is
  /// not made use of.
  static constexpr double kAround = 0.25;

  double share = 0.0;           ///< λ
  Eigen::Vector2d along{1, 0};  ///< u
  double room = 0.0;            ///< ρ [m]; not positive: the line is not inside of the soles' hull
  Eigen::Vector2d normal{0, 0};  ///< the gradient of ρ with respect to p, the soles held still

  /// Of soles of full length and width `sole_size` [m] at their places seen from above; `crosses`:
  /// where the line crosses the planes of the left and of the right one, in W [m].
  static SoleSection Widest(const Pose2& X_WL, const Pose2& X_WR, const Eigen::Vector2d& sole_size,
                            const std::array<Eigen::Vector2d, 2>& crosses);
};

}  // namespace halfstep
