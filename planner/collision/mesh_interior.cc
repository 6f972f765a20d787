#include "planner/collision/mesh_interior.h"

#include <cmath>
#include <utility>

#include "planner/collision/mesh_patches.h"
#include "wpg/check.h"

namespace halfstep {
namespace {

constexpr double kRayRounding = 1e-6;  // of sums of winding numbers

}  // namespace

MeshInterior::MeshInterior(const TriangleMesh& mesh) {
  HALFSTEP_CHECK(mesh.triangles.cols() > 0 && mesh.vertices.allFinite(), mesh.triangles.cols()
                                                                             << " triangles");
  for (const MeshPatch& found : FindPatches(mesh)) {
    Patch patch{.triangles = TriangleTree(found.mesh), .winding = {}, .closed = found.closed};
    patch.winding = MeshWinding(patch.triangles);
    patches_.push_back(std::move(patch));
    points_.emplace_back(found.mesh.vertices.col(0));
  }
}

bool MeshInterior::Contains(const Eigen::Vector3d& point) const {
  double sum = 0, absolute = 0;
  for (const Patch& patch : patches_) {
    const TriangleTree::Node& root = patch.triangles.nodes[0];
    // A closed patch winds around nothing beyond its bounds.
    if (patch.closed && ((point - root.center).cwiseAbs().array() > root.half.array()).any()) {
      continue;
    }
    const double winding = patch.winding.At(patch.triangles, point);
    if (!(std::abs(winding) <= 0.5)) return true;
    if (patch.closed) continue;
    sum += winding;
    absolute += std::abs(winding);
  }
  return std::abs(sum) > 0.5 || absolute > 1 - kRayRounding;
}

}  // namespace halfstep
