#pragma once

#include <Eigen/Geometry>
#include <limits>

#include "wpg/geometry/convex_body.h"

namespace halfstep {

/// A slab between two convex bodies and the nearest points found, all in the frame of `a`.
struct ConvexDistance {
  /// Width of the slab along `normal_A`, evaluated with the support functions: never exceeds the
  /// true signed distance. Negative: the slab is an overlap [m].
  double lower = 0.0;
  /// Distance of the two points: never less than the true distance; 0 on overlap [m].
  double upper = 0.0;
  Eigen::Vector3d normal_A{0, 0, 1};   ///< unit, from b towards a.
  Eigen::Vector3d point_a_A{0, 0, 0};  ///< on a [m].
  Eigen::Vector3d point_b_A{0, 0, 0};  ///< on b [m].
};

inline constexpr double kConverge = std::numeric_limits<double>::quiet_NaN();

/// Widest slab between two convex bodies. Disjoint ones: converges to the distance from both sides.
/// Overlapping ones: the best of the face normals, the axes and the line of centres, refined
/// locally, so `lower` may undercut the true (negative) signed distance.
/// It stops early once `lower` ≥ `enough` or `upper` < `enough` [m] answers the caller's question;
/// kConverge asks for the distance itself.
/// Source: [Gilbert1988]; the closest point of a triangle after [Ericson2005] §5.1.5.
ConvexDistance FindConvexDistance(const ConvexBody& a, const ConvexBody& b,
                                  const Eigen::Isometry3d& X_AB,
                                  const Eigen::Vector3d& first_normal_A, double enough);

}  // namespace halfstep
