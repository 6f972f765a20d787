#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/scene.h"

namespace halfstep {

/// One vertex of each connected component of the mesh (triangles that share a vertex index) [m].
std::vector<Eigen::Vector3d> ComponentPoints(const TriangleMesh& mesh);

/// How many times the surface winds around `point` (mesh frame): 1 inside a closed mesh with
/// outward triangles (−1 with inward ones), 0 outside, in between near the holes of an open one.
/// Not defined on the surface. Source: [Jacobson2013] eq. 5–6; the solid angle of a triangle after
/// [VanOosterom1983].
double WindingNumber(const TriangleMesh& mesh, const Eigen::Vector3d& point);

}  // namespace halfstep
