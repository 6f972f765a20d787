#pragma once

#include <vector>

#include "planner/scene/scene.h"

namespace halfstep {

/// Triangles joined by edges of exactly two triangles, turned alike.
struct MeshPatch {
  TriangleMesh mesh;    ///< its own vertices only.
  bool closed = false;  ///< each edge is one of two triangles.
};

/// The patches of a mesh (planner/collision/mesh_interior.h). Each is turned as most of its
/// triangles are.
std::vector<MeshPatch> FindPatches(const TriangleMesh& mesh);

}  // namespace halfstep
