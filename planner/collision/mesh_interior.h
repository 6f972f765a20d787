#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/collision/mesh_winding.h"
#include "planner/collision/triangle_tree.h"
#include "planner/scene/scene.h"

namespace halfstep {

/// What a triangle mesh surrounds, whichever way its triangles are turned.
///
/// Equal vertices are taken for one; a triangle that is there twice counts once, one with two equal
/// corners not at all. Triangles that share an edge with no third one belong to one patch and are
/// turned alike; a patch that cannot be turned so falls into single triangles. A patch is closed
/// when each of its edges is one of two triangles.
///
/// A point that is not on the surface is inside when
///   1. some patch winds around it by more than a half, or
///   2. the patches that are not closed do so in their sum, turned as most of their triangles, or
///   3. the absolute windings of the patches that are not closed add up to 1.
/// Promised, whatever the orientation of the triangles: a point is inside when some closed patch
/// winds around it (rule 1: patches never cancel), and when patches can be turned so that they make
/// a closed surface that winds around it (rule 3). So a cavity counts as inside, and so may a point
/// that large open patches surround; of an open mesh, inside is what rules 1 and 2 say. Not
/// promised: a single closed patch that passes through itself, where it winds once each way.
/// Source: winding numbers, [Jacobson2013].
class MeshInterior {
 public:
  /// Precondition: at least one triangle, finite vertices (std::logic_error).
  explicit MeshInterior(const TriangleMesh& mesh);

  /// Whether a point of the mesh's frame is inside.
  bool Contains(const Eigen::Vector3d& point) const;
  /// A vertex of each patch [m].
  const std::vector<Eigen::Vector3d>& points() const { return points_; }

 private:
  struct Patch {
    TriangleTree triangles;
    MeshWinding winding;
    bool closed = false;
  };
  std::vector<Patch> patches_;
  std::vector<Eigen::Vector3d> points_;
};

}  // namespace halfstep
