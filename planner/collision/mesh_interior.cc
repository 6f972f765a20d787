#include "planner/collision/mesh_interior.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>
#include <vector>

#include "planner/collision/mesh_patches.h"
#include "planner/collision/open_patches.h"
#include "planner/collision/patch_winding.h"
#include "planner/scene/voxel_set.h"
#include "wpg/check.h"
#include "wpg/geometry/bounds_tree.h"
#include "wpg/nth.h"

namespace halfstep {
struct MeshInterior::Patches {
  std::vector<Eigen::Vector3d> points;  // a vertex of each patch
  BoundsTree of_points;
  std::deque<PatchWinding> closed;
  BoundsTree of_closed;
  OpenPatches open;

  explicit Patches(const TriangleMesh& mesh);
  bool ClosedContain(const Eigen::Vector3d& point) const;
};

MeshInterior::Patches::Patches(const TriangleMesh& mesh) {
  std::vector<Eigen::AlignedBox3d> at_points, around_closed;
  if (mesh.cubes) {
    points = CornerOfEachPart(mesh);
    for (const Eigen::Vector3d& point : points) at_points.emplace_back(point);
    of_points = BoundsTree(at_points, 4);
    return;
  }
  std::vector<TriangleMesh> not_closed;
  for (MeshPatch& found : FindPatches(mesh)) {
    points.emplace_back(found.mesh.vertices.col(0));
    at_points.emplace_back(points.back());
    if (!found.closed) {
      not_closed.push_back(std::move(found.mesh));
      continue;
    }
    around_closed.emplace_back(Eigen::Vector3d(found.mesh.vertices.rowwise().minCoeff()),
                               Eigen::Vector3d(found.mesh.vertices.rowwise().maxCoeff()));
    closed.emplace_back(std::move(found.mesh));
  }
  of_points = BoundsTree(at_points, 4);
  of_closed = BoundsTree(around_closed, 4);
  open = OpenPatches(std::move(not_closed));
}

// A closed patch winds around nothing beyond its bounds.
bool MeshInterior::Patches::ClosedContain(const Eigen::Vector3d& point) const {
  bool inside = false;
  of_closed.ForEachNear(point, 0.0, [&](int32_t i) {
    inside = inside || !(std::abs(Nth(closed, i).At(point)) <= 0.5);
  });
  return inside;
}

MeshInterior::MeshInterior(TriangleMesh mesh) : mesh_(std::move(mesh)) {
  HALFSTEP_CHECK(mesh_.triangles.cols() > 0 && mesh_.vertices.allFinite(), mesh_.triangles.cols()
                                                                               << " triangles");
}

MeshInterior::~MeshInterior() = default;

const MeshInterior::Patches& MeshInterior::patches() const {
  std::call_once(once_, [this] {
    patches_ = std::make_unique<const Patches>(mesh_);
    mesh_.vertices.resize(3, 0);
    mesh_.triangles.resize(3, 0);
  });
  return *patches_;
}

bool MeshInterior::Contains(const Eigen::Vector3d& point) const {
  if (mesh_.hollow) return false;
  if (mesh_.cubes) return mesh_.cubes->Contains(point);
  return patches().ClosedContain(point) || patches().open.Contain(point);
}

bool MeshInterior::AnyPatch(const Eigen::Vector3d& center, double radius,
                            const std::function<bool(const Eigen::Vector3d&)>& holds) const {
  bool any = false;
  patches().of_points.ForEachNear(center, radius, [&](int32_t i) {
    const Eigen::Vector3d& point = Nth(patches().points, i);
    any = any || ((point - center).norm() <= radius && holds(point));
  });
  return any;
}

}  // namespace halfstep
