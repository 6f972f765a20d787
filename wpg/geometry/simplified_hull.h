#pragma once

#include <Eigen/Core>

#include "wpg/geometry/convex_body.h"

namespace halfstep {

/// Fewest vertices that SimplifyOutward takes.
inline constexpr int kFewestHullVertices = 24;

/// A convex body around another one.
struct SimplifiedHull {
  ConvexBody body;      ///< contains the other one whole.
  double excess = 0.0;  ///< no point of `body` is farther than this from the other one [m].
};

/// A body with at most `vertices` vertices around a hull that has more (a body of triangles,
/// without a disc); of these two the one with less excess:
///   1. the intersection of half-spaces that each touch the hull: those of its bounds along the
///   axes
///      and along the columns of `kept` (3×k, unit, k ≤ 6), those of its flat faces, the largest
///      first, and those of the faces that cut off most, one after the other;
///   2. unless directions are to be kept: some of the hull's vertices, each the farthest outside
///   the
///      hull of those before it, with a ball around.
/// That it contains the hull is checked afterwards: how far a vertex may lie outside at most,
/// rounding included, is the radius of the result's ball; in 1. it is of the order of rounding, so
/// that along `kept` the result reaches as far as the hull does. A hull that has no more vertices,
/// or of which no such body is found, is returned as it is, with an excess of 0. Preconditions:
/// vertices ≥ kFewestHullVertices, triangles, no disc (std::logic_error).
SimplifiedHull SimplifyOutward(const ConvexBody& hull, int vertices,
                               const Eigen::Matrix3Xd& kept = Eigen::Matrix3Xd(3, 0));

}  // namespace halfstep
