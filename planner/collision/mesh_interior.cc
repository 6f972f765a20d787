#include "planner/collision/mesh_interior.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <queue>
#include <utility>
#include <vector>

#include "planner/collision/bounds_tree.h"
#include "planner/collision/mesh_patches.h"
#include "planner/collision/mesh_winding.h"
#include "planner/collision/triangle_tree.h"
#include "planner/scene/voxel_set.h"
#include "wpg/check.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr double kRayRounding = 1e-6;  // of sums of winding numbers
constexpr double kInside = 0.5;        // of a winding number, beyond it

double AreaOf(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const Eigen::Vector3i& t : mesh.triangles.colwise()) {
    const Eigen::Vector3d a = mesh.vertices.col(t[0]), b = mesh.vertices.col(t[1]);
    area += 0.5 * (b - a).cross(mesh.vertices.col(t[2]) - a).norm();
  }
  return area;
}

}  // namespace

// The winding number of a patch is made ready when it is first asked for.
struct MeshInterior::Patch {
  explicit Patch(TriangleMesh its_mesh) : mesh(std::move(its_mesh)) {}

  double WindingAt(const Eigen::Vector3d& point) const {
    std::call_once(once, [this] {
      triangles = TriangleTree(mesh);
      winding = MeshWinding(triangles);
      mesh = {};
    });
    return winding.At(triangles, point);
  }

  mutable std::once_flag once;
  mutable TriangleMesh mesh;
  mutable TriangleTree triangles;
  mutable MeshWinding winding;
};

struct MeshInterior::Patches {
  std::vector<Eigen::Vector3d> points;  // a vertex of each patch
  BoundsTree of_points;
  std::deque<Patch> closed, open;
  BoundsTree of_closed, of_open;
  std::vector<double> areas;  // of the open patches below each node of `of_open` [m²]

  explicit Patches(const TriangleMesh& mesh);
  bool ClosedContain(const Eigen::Vector3d& point) const;
  bool OpenContain(const Eigen::Vector3d& point) const;
};

MeshInterior::Patches::Patches(const TriangleMesh& mesh) {
  std::vector<Eigen::AlignedBox3d> at_points, around_closed, around_open;
  if (mesh.cubes) {
    points = CornerOfEachPart(mesh);
    for (const Eigen::Vector3d& point : points) at_points.emplace_back(point);
    of_points = BoundsTree(at_points, 4);
    return;
  }
  std::vector<double> open_areas;
  for (MeshPatch& found : FindPatches(mesh)) {
    points.emplace_back(found.mesh.vertices.col(0));
    at_points.emplace_back(points.back());
    const Eigen::AlignedBox3d around(found.mesh.vertices.rowwise().minCoeff(),
                                     found.mesh.vertices.rowwise().maxCoeff());
    (found.closed ? around_closed : around_open).push_back(around);
    if (!found.closed) open_areas.push_back(AreaOf(found.mesh));
    (found.closed ? closed : open).emplace_back(std::move(found.mesh));
  }
  of_points = BoundsTree(at_points, 4);
  of_closed = BoundsTree(around_closed, 4);
  of_open = BoundsTree(around_open, 1);
  areas.resize(of_open.nodes.size());
  for (size_t n = areas.size(); n-- > 0;) {
    const BoundsTree::Node& node = of_open.nodes[n];
    areas[n] = node.left >= 0 ? Nth(areas, node.left) + Nth(areas, node.left + 1)
                              : Nth(open_areas, Nth(of_open.order, node.first));
  }
}

// A closed patch winds around nothing beyond its bounds.
bool MeshInterior::Patches::ClosedContain(const Eigen::Vector3d& point) const {
  bool inside = false;
  of_closed.ForEachNear(point, 0.0, [&](int32_t i) {
    inside = inside || !(std::abs(Nth(closed, i).WindingAt(point)) <= kInside);
  });
  return inside;
}

// Triangles of area A that are at least d away cover at most A/d² of the 4π of all directions, so
// they wind at most A/(4π d²). As long as such bounds and the windings that are known add up to
// more than a half, the part with the largest bound is looked at more closely.
bool MeshInterior::Patches::OpenContain(const Eigen::Vector3d& point) const {
  if (open.empty()) return false;
  double sum = 0, absolute = 0;  // of the windings that are known
  double bounds = 0;             // of those that are not
  std::priority_queue<std::pair<double, int32_t>> unknown;
  const auto add = [&](int32_t n) {
    const double far = BoundsTree::Gap(Nth(of_open.nodes, n), point);
    // One of 1 is enough to look on; a larger one would leave rounding when it is taken off.
    const double bound =
        std::min(Nth(areas, n) / (4 * std::numbers::pi * std::max(far * far, 1e-12)), 1.0);
    unknown.emplace(bound, n);
    bounds += bound;
  };
  add(0);
  while (!unknown.empty()) {
    if (absolute + bounds <= kInside - kRayRounding) return false;
    const auto [bound, n] = unknown.top();
    unknown.pop();
    bounds = unknown.empty() ? 0.0 : bounds - bound;
    const BoundsTree::Node& node = Nth(of_open.nodes, n);
    if (node.left >= 0) {
      add(node.left);
      add(node.left + 1);
      continue;
    }
    const int32_t patch = Nth(of_open.order, node.first);
    const double winding = Nth(open, patch).WindingAt(point);
    if (!(std::abs(winding) <= kInside)) return true;
    sum += winding;
    absolute += std::abs(winding);
  }
  return std::abs(sum) > kInside || absolute > 1 - kRayRounding;
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
  return patches().ClosedContain(point) || patches().OpenContain(point);
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
