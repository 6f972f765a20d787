#pragma once

#include <Eigen/Geometry>
#include <memory>

#include "planner/scene/scene.h"
#include "wpg/geometry/convex_body.h"

namespace halfstep {

/// How far two bodies are apart. Convex pairs: `distance` never exceeds the true signed distance
/// (beyond rounding, 1e-14 of the coordinates): it is the width of the slab between them along
/// `normal_W`, computed from their support functions. Zero or negative: contact or overlap; then it
/// is a lower bound of minus the penetration depth.
/// With a mesh: the largest of two numbers, neither of which exceeds the true distance. The slab to
/// a convex body around the mesh: its hull, wider by how far a vertex may lie outside it and by the
/// slab's rounding (4e-15 of the mesh's coordinates). And the distance of the triangles from the
/// body's core (the body without its ball; a disc is enclosed by a polygon of at least 64 sides, a
/// core without volume by one 1e-6 m thick) less the ball's radius and FCL's rounding (1e-12 of the
/// coordinates, at least 1e-10 m). A body that meets no triangle is in contact when it holds a part
/// of the mesh or is inside it (planner/collision/mesh_interior.h).
struct Separation {
  double distance = 0.0;               ///< [m]
  Eigen::Vector3d normal_W{0, 0, 1};   ///< unit, from b towards a.
  Eigen::Vector3d point_a_W{0, 0, 0};  ///< witness on a [m].
  Eigen::Vector3d point_b_W{0, 0, 0};  ///< witness on b [m].
};

/// A body prepared for collision queries (holds what FCL needs; FCL shows in separation.cc only).
/// Immutable, shared by copies, safe to use from several threads.
class CollisionShape {
 public:
  explicit CollisionShape(ConvexBody body);
  /// Precondition: at least one triangle, indices in range, finite vertices (std::logic_error).
  explicit CollisionShape(TriangleMesh mesh);
  /// Of an obstacle. Preconditions as above, and as for MakeBox and the like.
  explicit CollisionShape(const Shape& shape);

  bool is_mesh() const;
  const ConvexBody& convex() const;       ///< of a mesh: a convex body that contains it.
  const Eigen::Vector3d& center() const;  ///< of a bounding sphere, own frame [m].
  double radius() const;                  ///< of that sphere [m].

  struct Impl;
  const Impl& impl() const { return *impl_; }

 private:
  std::shared_ptr<const Impl> impl_;
};

/// min over a of n·x − max over b of n·x for a unit n_W: a lower bound of the signed distance of
/// convex bodies for every n, exact for the best one [m]. Precondition: n_W of length 1 within
/// 1e-9.
double SeparationAlong(const ConvexBody& a, const Eigen::Isometry3d& X_Wa, const ConvexBody& b,
                       const Eigen::Isometry3d& X_Wb, const Eigen::Vector3d& n_W);

/// Separation of two bodies, at most one of them a mesh. Precondition: finite poses
/// (std::logic_error). An exception inside FCL counts as contact.
/// Convex pairs do not ask FCL: on random pairs its libccd distance was more than 1e-6 m too large
/// for one in eight (up to 28 mm), and the bounds of FindConvexDistance never 1e-6 m apart.
Separation Separate(const CollisionShape& a, const Eigen::Isometry3d& X_Wa, const CollisionShape& b,
                    const Eigen::Isometry3d& X_Wb);

/// Whether the bodies are at least `clearance` [m] apart, by the same lower bound as Separate.
/// `normal_W` is the direction that separated them last (zero: none yet); it is tried first and
/// updated. Preconditions as for Separate.
bool ClearsAlongCached(const CollisionShape& a, const Eigen::Isometry3d& X_Wa,
                       const CollisionShape& b, const Eigen::Isometry3d& X_Wb, double clearance,
                       Eigen::Vector3d* normal_W);

}  // namespace halfstep
