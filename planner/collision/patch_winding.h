#pragma once

#include <Eigen/Core>
#include <mutex>
#include <utility>

#include "planner/collision/mesh_winding.h"
#include "planner/collision/triangle_tree.h"
#include "planner/scene/shape.h"

namespace halfstep {

/// The winding number of a patch, made ready when it is first asked for. Const and thread-safe.
class PatchWinding {
 public:
  /// Precondition: at least one triangle, finite vertices (std::logic_error when first asked).
  explicit PatchWinding(TriangleMesh mesh) : mesh_(std::move(mesh)) {}

  /// Around a point [m] that is not on the surface.
  double At(const Eigen::Vector3d& point) const {
    std::call_once(once_, [this] {
      triangles_ = TriangleTree(mesh_);
      winding_ = MeshWinding(triangles_);
      mesh_ = {};
    });
    return winding_.At(triangles_, point);
  }

 private:
  mutable std::once_flag once_;
  mutable TriangleMesh mesh_;
  mutable TriangleTree triangles_;
  mutable MeshWinding winding_;
};

}  // namespace halfstep
