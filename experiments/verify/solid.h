#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "experiments/verify/box_index.h"
#include "experiments/verify/min_norm_point.h"
#include "planner/scene/scene.h"
#include "wpg/geometry/convex_body.h"

namespace halfstep::verify {

/// A body or an obstacle as verify takes it: a convex set by its points, disc and ball, or the
/// triangles of a mesh one by one. Knows no hull, no FCL and no winding number of the program's.
class Solid {
 public:
  /// Of the body only vertices and radii are used.
  explicit Solid(const ConvexBody& body);
  /// Its triangles, by parts that are connected.
  explicit Solid(const TriangleMesh& mesh);

  const Eigen::Vector3d& lower() const { return lower_; }    ///< bounds in its own frame [m]
  const Eigen::Vector3d& upper() const { return upper_; }    ///< upper bounds [m]
  const Eigen::Vector3d& center() const { return center_; }  ///< of a ball that holds it
  double radius() const { return radius_; }                  ///< of that ball [m]

  /// A lower bound of the distance of a convex solid from any other [m]. It is 0 when they touch,
  /// and when a part of the mesh surrounds the convex solid.
  static double Distance(const Solid& convex, const Eigen::Isometry3d& X_Wa, const Solid& other,
                         const Eigen::Isometry3d& X_Wb);

 private:
  using Triangle = std::array<Eigen::Vector3d, 3>;
  // Triangles that are connected, each once.
  struct Part {
    std::vector<Triangle> triangles;
    BoxIndex index;  // of the triangles
  };
  void FindParts(const TriangleMesh& mesh);
  double FromTriangles(const ConvexSet& set, const Eigen::AlignedBox3d& bounds) const;
  bool Surrounds(const Eigen::Vector3d& point) const;

  ConvexSet set_;                    // empty: a mesh
  std::vector<Triangle> triangles_;  // of a mesh
  BoxIndex index_;                   // of these
  std::vector<Part> parts_;          // none of a hollow mesh: it surrounds nothing
  BoxIndex around_parts_;
  Eigen::Vector3d lower_{0, 0, 0}, upper_{0, 0, 0}, center_{0, 0, 0};
  double radius_ = 0;
};

}  // namespace halfstep::verify
