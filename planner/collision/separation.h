#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <memory>

#include "planner/scene/scene.h"
#include "wpg/geometry/convex_body.h"

namespace halfstep {

/// How far two bodies are apart. For convex bodies, `distance` is the width of the slab between
/// them along `normal_W`, computed from their support functions, so it never exceeds the true
/// signed distance (beyond rounding, 1e-14 of the coordinates). Zero or negative means contact or
/// overlap; then it is a lower bound of minus the penetration depth.
/// With a mesh, it is the larger of two numbers, neither of which exceeds the true distance:
///   1. the slab to a convex body around the mesh: its hull (the axis-aligned bounds of a mesh that
///      is flat or has more than 20,000 triangles), widened by how far a vertex may lie outside and
///      by the slab's rounding (4e-15 of the mesh's coordinates);
///   2. the distance of the triangles from the body's core (FCL), less the ball's radius and
///      rounding (1e-12 of the coordinates, at least 1e-10 m), as far as slabs between the body and
///      each triangle prove it. The core is the body without its
///      ball; a disc is enclosed by a polygon of at least 64 sides, and a core without volume is
///      widened by 1e-6 m.
/// A body that meets no triangle is in contact all the same when it holds a part of the mesh or is
/// inside it (planner/collision/mesh_interior.h), unless the mesh is hollow.
struct Separation {
  double distance = 0.0;               ///< [m]
  Eigen::Vector3d normal_W{0, 0, 1};   ///< unit, from b towards a.
  Eigen::Vector3d point_a_W{0, 0, 0};  ///< witness on a [m].
  Eigen::Vector3d point_b_W{0, 0, 0};  ///< witness on b [m].
};

/// A body prepared for collision queries. Immutable, shared by copies, safe to use from several
/// threads.
class CollisionShape {
 public:
  /// Precondition: at least one vertex, all finite, and radii ≥ 0 (std::logic_error).
  explicit CollisionShape(ConvexBody body);
  /// Precondition: at least one triangle, indices in range, finite vertices (std::logic_error).
  explicit CollisionShape(TriangleMesh mesh);
  /// The shape of an obstacle. The preconditions are those above and those of BodyOf.
  explicit CollisionShape(const Shape& shape);

  bool is_mesh() const;  ///< whether it is a surface of triangles, and not a convex body
  const ConvexBody& convex() const;       ///< of a mesh: a convex body that contains it.
  const Eigen::Vector3d& center() const;  ///< of a bounding sphere, own frame [m].
  double radius() const;                  ///< of that sphere [m].

  struct Impl;
  /// For Separate alone: FCL's types stay in one source.
  const Impl& impl() const { return *impl_; }

 private:
  std::shared_ptr<const Impl> impl_;
};

/// Width of the slab between two convex bodies along a unit n_W [m]: min over a of n·x − max over b
/// of n·x. For every n it is a lower bound of their signed distance, and the best n attains it when
/// they are apart. Precondition: n_W has length 1 within 1e-9 (std::logic_error).
double SeparationAlong(const ConvexBody& a, const Eigen::Isometry3d& X_Wa, const ConvexBody& b,
                       const Eigen::Isometry3d& X_Wb, const Eigen::Vector3d& n_W);

/// Separation of two bodies. Preconditions: at most one of them is a mesh, and the poses are finite
/// (std::logic_error). An exception inside FCL counts as contact. FCL is not asked about convex
/// pairs: on random pairs its libccd distance was more than 1e-6 m too large for one in eight (by
/// up to 28 mm), while the two bounds of FindConvexDistance were never 1e-6 m apart.
/// A mesh that is at least `cap` [m] away may be told as any distance from `cap` up to the
/// true one, without witness points: then its far triangles cost nothing.
Separation Separate(const CollisionShape& a, const Eigen::Isometry3d& X_Wa, const CollisionShape& b,
                    const Eigen::Isometry3d& X_Wb,
                    double cap = std::numeric_limits<double>::infinity());

/// Whether the bodies are at least `clearance` [m] apart, by the same lower bound as Separate.
/// `normal_W` is the direction that separated them last (zero: none yet). It is tried first, and
/// updated; the answer does not depend on it. The preconditions are those of Separate.
bool ClearsAlongCached(const CollisionShape& a, const Eigen::Isometry3d& X_Wa,
                       const CollisionShape& b, const Eigen::Isometry3d& X_Wb, double clearance,
                       Eigen::Vector3d* normal_W);

}  // namespace halfstep
