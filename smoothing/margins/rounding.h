#pragma once

#include "wpg/motion/walk_state.h"

namespace halfstep {

/// How far rounding may carry the margin of a point inside the support polygon of soles that are
/// off by at most `off`, where the walk's quantities are `x` [m]. The polygon leaves out edges
/// below 1e-9 m, which is at most (1e-9 m)²/margin. Source: smoothing/README.md, "Rounding", 4.
double SupportRounding(const WalkState& x, const WalkState& off, const Eigen::Vector2d& sole_size,
                       double margin);

/// The same of the distance, seen from above, between a sole's outline about a place [m] and
/// another polygon, but for how far the place may be off: corners turned and moved, and their
/// differences.
double PlanarRounding(double x, double y);

/// How far rounding may carry a distance of the robot's bodies, or a height, from that of bodies
/// that are exactly where they were computed to be [m]: sums of products of their coordinates, and
/// of what is within 8 m. Obstacles' own coordinates are looked after in planner/collision.
double DistanceRounding(const WalkState& x);

}  // namespace halfstep
