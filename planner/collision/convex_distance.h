#pragma once

#include <Eigen/Geometry>
#include <limits>

#include "wpg/geometry/convex_body.h"

namespace halfstep {

/// A slab between two convex bodies and the nearest points that were found, all in the frame of
/// `a`.
struct ConvexDistance {
  /// Width of the slab along `normal_A` [m]. It is evaluated with the support functions, so it
  /// never exceeds the true signed distance. Negative: along `normal_A` the bodies overlap by that
  /// much.
  double lower = 0.0;
  /// Distance of the two points [m], never less than the true distance; 0 when the bodies overlap.
  double upper = 0.0;
  Eigen::Vector3d normal_A{0, 0, 1};   ///< unit, from b towards a.
  Eigen::Vector3d point_a_A{0, 0, 0};  ///< on a [m].
  Eigen::Vector3d point_b_A{0, 0, 0};  ///< on b [m].
};

/// As `enough`: the search ends only when both bounds have met.
inline constexpr double kConverge = std::numeric_limits<double>::quiet_NaN();

/// The widest slab between two convex bodies. When they are disjoint, both bounds converge to their
/// distance. When they overlap, the slab is the best along the face normals, the axes and the line
/// of centres, refined locally, so `lower` may be below the true (negative) signed distance.
/// `first_normal_A` is the direction from b towards a that is tried first, of any length. The
/// search stops early once `lower` ≥ `enough` or `upper` < `enough` [m] answers the caller's
/// question; kConverge asks for the distance itself.
/// Source: [Gilbert1988]; the closest point of a triangle after [Ericson2005] §5.1.5.
ConvexDistance FindConvexDistance(const ConvexBody& a, const ConvexBody& b,
                                  const Eigen::Isometry3d& X_AB,
                                  const Eigen::Vector3d& first_normal_A, double enough);

}  // namespace halfstep
