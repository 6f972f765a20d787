#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <mutex>

#include "planner/scene/shape.h"

namespace halfstep {

/// What a triangle mesh surrounds, whichever way its triangles are turned.
///
/// Equal vertices count as one. A triangle that is there twice counts once, and one with two equal
/// corners does not count. Triangles that share an edge with no third one belong to one patch and
/// are turned alike; a patch whose triangles cannot be turned alike falls into single triangles. A
/// patch is closed when each of its edges belongs to two triangles.
///
/// A point that is not on the surface is inside when
///   1. some patch winds around it by more than a half, or
///   2. the patches that are not closed, each turned as most of its triangles, do so in sum, or
///   3. the absolute windings of the patches that are not closed add up to 1.
/// Whatever the orientation of the triangles, a point is sure to be inside when some closed patch
/// winds around it (rule 1: patches never cancel), and when patches can be turned so that they make
/// a closed surface that winds around it (rule 3). So a cavity counts as inside, and so may a point
/// that large open patches surround; what is inside an open mesh is for rules 1 and 2 to say.
/// Nothing is inside a hollow mesh, and inside a surface of cubes are these cubes: no winding
/// number is asked for, of which a scanned room has very many patches. Nothing is promised where a
/// single closed patch passes through itself and winds once each way. Source: winding numbers,
/// [Jacobson2013].
class MeshInterior {
 public:
  /// Precondition: at least one triangle, finite vertices (std::logic_error). Patches are found
  /// when first asked for, and what is needed of a patch when a point first comes near it.
  explicit MeshInterior(TriangleMesh mesh);
  ~MeshInterior();

  /// Whether a point of the mesh's frame [m] is inside. Closed patches far from it cost nothing,
  /// open ones little.
  bool Contains(const Eigen::Vector3d& point) const;
  /// Whether `holds` is true of some point of the mesh's surface within `radius` [m] of `center`,
  /// of one vertex of each patch (of cubes: of each connected part), in the mesh's frame.
  bool AnyPatch(const Eigen::Vector3d& center, double radius,
                const std::function<bool(const Eigen::Vector3d&)>& holds) const;

 private:
  struct Patches;
  const Patches& patches() const;

  mutable std::once_flag once_;
  mutable TriangleMesh mesh_;  // until the patches are found
  mutable std::unique_ptr<const Patches> patches_;
};

}  // namespace halfstep
