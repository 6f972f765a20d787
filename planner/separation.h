#pragma once

#include <Eigen/Geometry>
#include <memory>

#include "planner/scene.h"
#include "wpg/convex_body.h"

namespace halfstep {

/// How far two bodies are apart. `distance` never exceeds the true signed distance: it is the
/// width of a slab between them along `normal_W`, computed from their support functions, whatever
/// the library that proposed the direction says. Negative: no separating slab found (a lower bound
/// of the negative penetration depth).
struct Separation {
  double distance = 0.0;               ///< [m]
  Eigen::Vector3d normal_W{0, 0, 1};   ///< unit, from b towards a.
  Eigen::Vector3d point_a_W{0, 0, 0};  ///< witness on a [m].
  Eigen::Vector3d point_b_W{0, 0, 0};  ///< witness on b [m].
};

/// A body prepared for collision queries (holds what FCL needs; FCL shows in separation.cc only).
/// Immutable and shared by copies.
class CollisionShape {
 public:
  explicit CollisionShape(ConvexBody body);
  explicit CollisionShape(TriangleMesh mesh);

  bool is_mesh() const;
  const ConvexBody& convex() const;       ///< of the mesh: its convex hull's sphere only.
  const Eigen::Vector3d& center() const;  ///< of a bounding sphere, own frame [m].
  double radius() const;                  ///< of that sphere [m].

  struct Impl;
  const Impl& impl() const { return *impl_; }

 private:
  std::shared_ptr<const Impl> impl_;
};

/// min over a of n·x − max over b of n·x for a unit n_W: a lower bound of the signed distance of
/// convex bodies for every n, exact for the best one [m].
double SeparationAlong(const ConvexBody& a, const Eigen::Isometry3d& X_Wa, const ConvexBody& b,
                       const Eigen::Isometry3d& X_Wb, const Eigen::Vector3d& n_W);

/// Separation of two bodies, at most one of them a mesh. Precondition: finite poses
/// (std::logic_error). An exception inside FCL counts as contact.
Separation Separate(const CollisionShape& a, const Eigen::Isometry3d& X_Wa, const CollisionShape& b,
                    const Eigen::Isometry3d& X_Wb);

}  // namespace halfstep
