#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

namespace halfstep::verify {

/// A convex set in W: the sum of the hull of `points`, a disc and a ball.
struct ConvexSet {
  std::vector<Eigen::Vector3d> points;  ///< [m], at least one
  double disc = 0;                      ///< radius [m]
  Eigen::Vector3d disc_axis{0, 0, 1};   ///< unit normal of the disc
  double ball = 0;                      ///< radius [m]
};

/// Two numbers that the distance of two sets lies between [m]: `upper` is the distance of two of
/// their points, `lower` the width of a slab between them; both are 0 when they meet.
struct Bracket {
  double lower = 0, upper = 0;  ///< lower ≤ upper
};

/// The distance of two convex sets: the point of least norm of their difference, by Wolfe's method
/// ("Finding the nearest point in a polytope", 1976), in extended precision. The result proves
/// itself, for it has both bounds; what rounding of the points' coordinates may add is taken off
/// `lower`. The search may end as soon as `lower` is at least `enough` [m].
Bracket DistanceOf(const ConvexSet& a, const ConvexSet& b,
                   double enough = std::numeric_limits<double>::infinity());

}  // namespace halfstep::verify
