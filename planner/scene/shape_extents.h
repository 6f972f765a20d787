#pragma once

#include <Eigen/Core>

#include "planner/scene/shape.h"

namespace halfstep {

/// Half the edges of the smallest box along the axes of its frame that holds a shape, both centred
/// at the origin [m]. The preconditions are those of BodyOf.
Eigen::Vector3d HalfExtents(const Box& box);
Eigen::Vector3d HalfExtents(const Sphere& sphere);      ///< of a ball
Eigen::Vector3d HalfExtents(const Cylinder& cylinder);  ///< of a cylinder
Eigen::Vector3d HalfExtents(const Capsule& capsule);    ///< of a capsule

}  // namespace halfstep
