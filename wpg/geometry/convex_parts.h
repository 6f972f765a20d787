#pragma once

#include <Eigen/Core>
#include <vector>

#include "wpg/geometry/convex_body.h"

namespace halfstep {

/// At most `parts` convex bodies that contain a mesh together: all of its triangles, and all that
/// these enclose. The mesh is cut by planes along the axes of its frame, one after the other, each
/// where the hulls of both sides have least volume together; a cut that does not save 1 % of the
/// volume of the mesh's hull is not made, and one part is the hull itself. Where a plane cuts, both
/// sides get the hull of what it cuts: so a side's hull contains what the mesh encloses there,
/// whether the mesh is closed elsewhere or not. Each body of a mesh
/// that is cut has a ball of 1e-12 of the coordinates around, which is more than its corners on
/// cuts may be off by rounding (some 1e-15). `vertices` (3×n) and `triangles` (3×m) as in
/// LoadedMesh. Throws std::runtime_error with a sentence when the mesh has no hull. Precondition:
/// parts ≥ 1 (std::logic_error). Source: wpg/README.md, "Meshes in parts".
std::vector<ConvexBody> CutIntoConvexParts(const Eigen::Matrix3Xd& vertices,
                                           const Eigen::Matrix3Xi& triangles, int parts);

}  // namespace halfstep
