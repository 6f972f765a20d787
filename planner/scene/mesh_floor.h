#pragma once

#include <Eigen/Geometry>

#include "planner/scene/shape.h"

namespace halfstep {

/// A mesh without the floor that it brings along (`floor: in_mesh`, planner/README.md).
struct CutMesh {
  TriangleMesh rest;     ///< hollow; what sticks out of the floor, whole triangles. May be empty.
  int floor = 0;         ///< triangles that were taken out
  double area = 0.0;     ///< of the nearly horizontal ones within the tolerance of the floor [m²]
  double highest = 0.0;  ///< point of what was taken out, above the floor [m], ≤ tolerance
  int deep = 0;          ///< triangles of these that reach below −tolerance
};

/// Takes every triangle out of a mesh at X_WO that lies wholly at or below `tolerance` [m] above
/// the floor (Ground::Floor) at z = `floor` [m], however it is turned. Nothing that is taken out
/// stands more than the tolerance above the floor on which the robot steps, and what is left is as
/// it was.
CutMesh CutFloor(const TriangleMesh& mesh, const Eigen::Isometry3d& X_WO, double floor,
                 double tolerance);

/// The area of a mesh's nearly horizontal triangles (steeper by at most 10°) within `tolerance` [m]
/// of the floor [m²].
double FloorArea(const TriangleMesh& mesh, const Eigen::Isometry3d& X_WO, double floor,
                 double tolerance);

/// The tolerance of `floor: in_mesh` where none is given [m]: the noise of scans is usually below.
/// A sole meets what is higher so much before it is planned to land.
inline constexpr double kFloorTolerance = 0.005;

}  // namespace halfstep
