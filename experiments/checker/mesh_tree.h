#pragma once

#include <vector>

#include "experiments/checker/frame.h"
#include "experiments/verify/box_index.h"
#include "planner/scene/shape.h"

namespace halfstep::checker {

/// Bodies that are free of a mesh keep as far off its triangles at least [m].
inline constexpr double kNoTouch = 1e-9;

/// The triangles of a mesh in its own frame, for bodies that are within its hull.
class MeshTree {
 public:
  /// Borrows the mesh.
  explicit MeshTree(const TriangleMesh& mesh);

  /// A convex body that holds all of it: its hull, or of a hollow, large or flat one the box
  /// around.
  ConvexBody Around() const;
  /// Its triangles but those that are farther than `reach` [m] from all of a point's places.
  std::vector<ConvexBody> Near(const Vector& point, double reach) const;
  /// Whether a point that is kNoTouch off all triangles is surely not inside: in none of the cubes
  /// where the mesh is the surface of some, and else where a ray along an axis meets no triangle,
  /// so that nothing that is closed winds around it. All that a hollow mesh surrounds is outside.
  bool IsOutside(const Vector& point) const;

 private:
  Eigen::Matrix3d Corners(size_t triangle) const;

  const TriangleMesh& mesh_;
  verify::BoxIndex index_;
};

}  // namespace halfstep::checker
