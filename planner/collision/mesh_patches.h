#pragma once

#include <vector>

#include "planner/scene/scene.h"

namespace halfstep {

/// Triangles that are joined by edges of exactly two triangles, all turned alike.
struct MeshPatch {
  TriangleMesh mesh;    ///< its own vertices only.
  bool closed = false;  ///< each edge belongs to two triangles.
};

/// The patches of a mesh, as planner/collision/mesh_interior.h defines them. Each is turned as most
/// of its triangles are.
std::vector<MeshPatch> FindPatches(const TriangleMesh& mesh);

/// A corner [m] of each part of a mesh whose triangles are joined by the numbers of their corners.
std::vector<Eigen::Vector3d> CornerOfEachPart(const TriangleMesh& mesh);

}  // namespace halfstep
