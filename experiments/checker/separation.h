#pragma once

#include <Eigen/Geometry>

#include "experiments/checker/frame.h"
#include "wpg/geometry/convex_body.h"

namespace halfstep::checker {

/// A hint: about how far two convex bodies at poses of doubles are apart [m], ≤ 0 where they meet,
/// and a unit direction from a to b along which they are separated by about that.
struct SeparationHint {
  double distance = 0.0;               ///< [m]
  Eigen::Vector3d direction{0, 0, 1};  ///< in W
};
/// By the point of the Minkowski difference b ⊖ a that is nearest to the origin [Gilbert1988].
/// Nothing rests on it: what is claimed is tested by GapAlong.
SeparationHint HintOf(const ConvexBody& a, const Eigen::Isometry3d& X_WA, const ConvexBody& b,
                      const Eigen::Isometry3d& X_WB);

/// A lower bound of min over b − max over a of n·x/|n| [m], for all frames of the intervals; the
/// bodies are at least that far apart where it is positive.
double GapAlong(const Eigen::Vector3d& n, const ConvexBody& a, const Frame& X_WA,
                const ConvexBody& b, const Frame& X_WB);

/// A lower bound of n·x over a body, for all frames of the intervals.
double LeastAlong(const Eigen::Vector3d& n, const ConvexBody& body, const Frame& X);

}  // namespace halfstep::checker
