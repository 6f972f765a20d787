#pragma once

#include <Eigen/Core>

#include "wpg/geometry/convex_body.h"

namespace halfstep {

/// How far points (3×n) [m] lie outside the convex hull of a body's vertices at most, rounding
/// included: each point is no farther than this from a convex combination of vertices [m]. 0 when
/// all points are vertices; of the order of rounding, 1e-15 of the coordinates, when all are
/// inside. Precondition: the body has triangles.
double OutsideBound(const ConvexBody& body, const Eigen::Matrix3Xd& points);

}  // namespace halfstep
