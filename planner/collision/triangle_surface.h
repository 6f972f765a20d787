#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <memory>
#include <optional>

#include "planner/scene/shape.h"
#include "wpg/geometry/convex_body.h"

namespace halfstep {

/// The triangles of a mesh, for distances between two surfaces and from a convex body. They lie in
/// blocks, and what FCL needs of a block is built when something first comes near it: what is far
/// away costs nothing but its place in a tree. FCL appears in triangle_surface.cc only. Immutable
/// as seen from outside, safe to use from several threads.
class TriangleSurface {
 public:
  /// In one block: for a body that is small.
  static constexpr int kOneBlock = std::numeric_limits<int>::max();
  static constexpr int kBlock = 512;  ///< triangles of a block otherwise

  /// Precondition: at least one triangle, indices in range, finite vertices (std::logic_error).
  explicit TriangleSurface(TriangleMesh mesh, int block = kBlock);
  ~TriangleSurface();

  const TriangleMesh& mesh() const;  ///< as given
  /// Blocks that were needed so far.
  int built() const;

  /// What was found between two surfaces.
  struct Nearest {
    double distance = 0.0;  ///< [m], 0 when they meet; exact up to FCL's rounding
    Eigen::Vector3d point_a_W{0, 0, 0}, point_b_W{0, 0, 0};  ///< the two nearest points, in W [m]
  };
  /// The distance of surface a, which lies within the ball `radius` [m] around `center_W`, from b;
  /// none when it is at least `cap` > 0 [m]. Of a only the first block is taken: it shall have
  /// one. Throws what FCL throws.
  static std::optional<Nearest> Distance(const TriangleSurface& a, const Eigen::Isometry3d& X_Wa,
                                         const Eigen::Vector3d& center_W, double radius,
                                         const TriangleSurface& b, const Eigen::Isometry3d& X_Wb,
                                         double cap);

  /// The least width of slabs between a convex body, placed at X_MB in the mesh's frame, and each
  /// of the triangles [m]: by support functions alone, so it never exceeds the distance from any
  /// (beyond rounding, 1e-14 of the coordinates). `enough` where all are as wide. `first_M`, from
  /// the triangles to the body, unit or zero, is the direction that is tried first.
  double LeastSlab(const ConvexBody& body, const Eigen::Isometry3d& X_MB,
                   const Eigen::Vector3d& first_M, double enough) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace halfstep
