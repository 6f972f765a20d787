#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <vector>

#include "planner/collision/patch_winding.h"
#include "planner/scene/shape.h"
#include "wpg/geometry/bounds_tree.h"

namespace halfstep {

/// The patches of a mesh that are not closed, each turned as it is, w_i their winding numbers
/// around a point. Few of them are asked for: those below a node of a tree wind together as much as
/// their area, seen from the point, says within bounds that hold. Const and thread-safe.
///
/// Bounds of a node: patches of area A with centroid g lie at least d from the point x; û is the
/// direction from x to g, ρ the distance. A piece dA with normal n at y winds K(y) dA/4π with
/// K(y) = n·(y − x)/|y − x|³, whose second derivatives are at most 6/d⁴. So with N = ∫ n dA,
/// P = ∫ n (y − g)ᵀ dA and S = ∫ |y − g|² dA
///     4πΣ w_i = N·û/ρ² + (tr P − 3ûᵀPû)/ρ³  to  3S/d⁴.
/// With each patch turned towards one axis the same bounds Σ|w_i| from below, since
/// |Σ ±w_i| ≤ Σ|w_i|, and from above where every triangle is seen from the same side. Elsewhere
/// from above, with M = ∫ n nᵀ dA and directions that differ from û by at most δ,
///     4πΣ|w_i| ≤ (√(A·ûᵀMû) + Aδ)/d².
/// Source: [Jacobson2013] for the winding numbers; far parts taken together as in [Barill2018].
class OpenPatches {
 public:
  OpenPatches() = default;  ///< none
  /// Each with at least one triangle and finite vertices.
  explicit OpenPatches(std::vector<TriangleMesh> patches);

  /// Whether some |w_i| > 1/2, or |Σ w_i| > 1/2, or Σ|w_i| ≥ 1, to 10⁻⁶, around a point that is not
  /// on the surface: rules 1 to 3 of planner/collision/mesh_interior.h. `asked`, when given, counts
  /// the patches whose windings were asked for.
  bool Contain(const Eigen::Vector3d& point, int* asked = nullptr) const;
  /// The same by the winding of every patch: for tests.
  bool ContainOneByOne(const Eigen::Vector3d& point) const;

 private:
  // The integrals above, of patches as they are turned.
  struct Sums {
    Eigen::Vector3d normals{0, 0, 0};                   // N [m²]
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();  // P [m³]
  };
  // What is known of the patches below a node, and of one patch.
  struct Part {
    double area = 0.0;                                  // A [m²]
    Eigen::Vector3d centroid{0, 0, 0};                  // g [m]
    double radius = 0.0;                                // no point is farther from g [m]
    double spread = 0.0;                                // S [m⁴]
    Sums as_is, aligned;                                // each patch as it is; turned to the axis
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();  // M [m²]
    Eigen::Vector3d axis{0, 0, 1};                      // of the aligned normals, unit
    double off_axis = 2.0;                              // no such normal is farther from it
    double thickness = 0.0;                             // |axis·(y − g)| at most [m]
  };
  // Bounds of what they wind around a point.
  struct Look;

  static Part PartOf(const TriangleMesh& patch);
  Part Together(const BoundsTree::Node& node, const std::vector<Part>& patches) const;
  Look LookAt(int32_t node, const Eigen::Vector3d& point) const;

  std::deque<PatchWinding> patches_;
  BoundsTree tree_;
  std::vector<Part> parts_;  // by node
};

}  // namespace halfstep
