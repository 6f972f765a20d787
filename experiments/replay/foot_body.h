#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "wpg/geometry/convex_body.h"

namespace halfstep::replay {

/// What of a foot's body is at least `least` [m] above its sole, in the body's frame: bodies of
/// vertices alone are cut there, of others the axis is shortened. None: nothing is. So the ground
/// on which a sole stands meets the sole alone, and a riser all that is higher. `X_SoleBody`: the
/// body's frame as seen from the sole.
std::optional<ConvexBody> AboveSole(const ConvexBody& body, const Eigen::Isometry3d& X_SoleBody,
                                    double least);

}  // namespace halfstep::replay
