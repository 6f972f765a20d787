#pragma once

#include "planner/scene/scene.h"
#include "wpg/geometry/convex_body.h"

namespace halfstep {

/// The surface of a body, to be drawn: exact for what has flat faces; discs as prisms of 32 sides
/// and balls as polyhedra, both inscribed (at 32 sides 0.5 % of the radius are missing).
TriangleMesh DrawnMesh(const ConvexBody& body);

/// A mesh of at most `most` triangles: the same, or one whose vertices are joined over the coarsest
/// lattice that it takes. For the eye only: it neither contains the mesh nor lies in it.
TriangleMesh Coarsened(const TriangleMesh& mesh, int most);

}  // namespace halfstep
