#include "experiments/checker/mesh_tree.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "planner/scene/voxel_set.h"

namespace halfstep::checker {
namespace {

constexpr Eigen::Index kMostInHull = 20'000;  // triangles of a mesh that has a hull
// A point in an interval of this width is less than kNoTouch from its middle, so that both are on
// the same side of a surface that is so far [m].
constexpr double kNarrow = 0.5 * kNoTouch;

Eigen::AlignedBox3d BoxOf(const Vector& v) {
  return {Eigen::Vector3d(v[0].lo, v[1].lo, v[2].lo), Eigen::Vector3d(v[0].hi, v[1].hi, v[2].hi)};
}

// Whether the ray from p along an axis surely meets no point of a triangle. As seen along it the
// corners a, b, c turn around p by the signs of the products; a triangle that holds p has no two
// that differ.
bool Misses(const Eigen::Matrix3d& corners, const Vector& p, size_t axis, double sign) {
  std::array<Vector, 3> to;
  bool behind = true;
  for (size_t i = 0; i < 3; ++i) {
    to[i] = VectorOf(corners.col(static_cast<Eigen::Index>(i))) - p;
    behind = behind && (sign > 0.0 ? to[i][axis].hi < 0.0 : to[i][axis].lo > 0.0);
  }
  bool left = false, right = false;
  for (size_t i = 0; i < 3; ++i) {
    const Interval turn = Cross(to[i], to[(i + 1) % 3])[axis];
    left = left || turn.lo > 0.0;
    right = right || turn.hi < 0.0;
  }
  return behind || (left && right);
}

}  // namespace

MeshTree::MeshTree(const TriangleMesh& mesh) : mesh_(mesh) {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (size_t i = 0; i < static_cast<size_t>(mesh.triangles.cols()); ++i) {
    const Eigen::Matrix3d corners = Corners(i);
    boxes.emplace_back(corners.rowwise().minCoeff(), corners.rowwise().maxCoeff());
  }
  index_ = verify::BoxIndex(std::move(boxes));
}

Eigen::Matrix3d MeshTree::Corners(size_t triangle) const {
  Eigen::Matrix3d corners;
  for (Eigen::Index k = 0; k < 3; ++k) {
    corners.col(k) = mesh_.vertices.col(mesh_.triangles(k, static_cast<Eigen::Index>(triangle)));
  }
  return corners;
}

ConvexBody MeshTree::Around() const {
  if (!mesh_.hollow && !mesh_.cubes && mesh_.triangles.cols() <= kMostInHull) {
    try {
      return MakeHull(mesh_.vertices);
    } catch (const std::runtime_error&) {  // flat
    }
  }
  const Eigen::AlignedBox3d box(mesh_.vertices.rowwise().minCoeff(),
                                mesh_.vertices.rowwise().maxCoeff());
  ConvexBody body;
  body.vertices.resize(3, 8);
  for (int i = 0; i < 8; ++i) {
    body.vertices.col(i) = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
  }
  BoundBySphere(&body);
  return body;
}

std::vector<ConvexBody> MeshTree::Near(const Vector& point, double reach) const {
  const Interval around(-reach, reach);
  std::vector<ConvexBody> near;
  for (const size_t i :
       index_.Meeting(BoxOf({point[0] + around, point[1] + around, point[2] + around}))) {
    ConvexBody& triangle = near.emplace_back();
    triangle.vertices = Corners(i);
    BoundBySphere(&triangle);
  }
  return near;
}

bool MeshTree::IsOutside(const Vector& point) const {
  if (mesh_.hollow) return true;
  const Eigen::Vector3d about(point[0].Middle(), point[1].Middle(), point[2].Middle());
  if (mesh_.cubes) {
    double wide = 0.0;
    for (const Interval& x : point) wide = std::max(wide, Above(x.hi - x.lo));
    return wide < kNarrow && !mesh_.cubes->Contains(about);
  }
  constexpr double kEverywhere = std::numeric_limits<double>::infinity();
  for (size_t axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      Eigen::AlignedBox3d ray = BoxOf(point);
      (sign > 0.0 ? ray.max() : ray.min())[static_cast<Eigen::Index>(axis)] = sign * kEverywhere;
      if (std::ranges::all_of(index_.Meeting(ray),
                              [&](size_t i) { return Misses(Corners(i), point, axis, sign); })) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace halfstep::checker
