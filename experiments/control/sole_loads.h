#pragma once

#include <array>

#include "experiments/control/tracking_controller.h"

namespace halfstep::control {

/// Which soles a plan has on the floor; both where it has none.
std::array<bool, 2> SolesOnFloor(const PlannedState& plan);

/// The point nearest to `p` [m], in W, in the plane PlannedState::zmp_height, of the hull of the
/// soles on the floor, each edge of a sole moved inwards by the share `inset` of that side's
/// length. Of soles at other heights it is that of the shadows that they cast there along the
/// planned force. Source: wpg/README.md, "Soles at different heights".
Eigen::Vector2d NearestInSupport(const PlannedState& plan, const Eigen::Vector2d& sole_size,
                                 double inset, const Eigen::Vector2d& p);

/// The loads of soles of full length and width `sole_size` [m] that together give the planned force
/// on the line, as tilted as planned, through `zmp` [m], in W, in the plane
/// PlannedState::zmp_height. Source: FootLoads, [Kajita2010].
std::array<SoleLoad, 2> SharedLoads(const PlannedState& plan, const Eigen::Vector2d& sole_size,
                                    const Eigen::Vector2d& zmp);

}  // namespace halfstep::control
