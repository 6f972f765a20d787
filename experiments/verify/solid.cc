#include "experiments/verify/solid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "wpg/nth.h"

namespace halfstep::verify {
namespace {

constexpr double kBoundRounding = 1e-9;  // [m] that bounds are widened by

Eigen::AlignedBox3d Bounds(const ConvexSet& set) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : set.points) box.extend(p);
  const Eigen::Vector3d around = Eigen::Vector3d::Constant(set.disc + set.ball + kBoundRounding);
  return {box.min() - around, box.max() + around};
}

ConvexSet Moved(const Eigen::Isometry3d& X, ConvexSet set) {
  for (Eigen::Vector3d& p : set.points) p = X * p;
  set.disc_axis = X.linear() * set.disc_axis;
  return set;
}

Eigen::AlignedBox3d Around(const std::array<Eigen::Vector3d, 3>& triangle) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : triangle) box.extend(p);
  return box;
}

std::vector<Eigen::AlignedBox3d> AroundEach(
    const std::vector<std::array<Eigen::Vector3d, 3>>& triangles) {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const auto& triangle : triangles) boxes.push_back(Around(triangle));
  return boxes;
}

// Whether a ray in no coordinate plane may meet a box: by slabs, a little widened.
bool MayMeet(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& from,
             const Eigen::Vector3d& along) {
  double begin = 0, end = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double rounding =
        1e-9 * (1 + std::abs(from[axis]) + std::abs(box.min()[axis]) + std::abs(box.max()[axis]));
    const double to_min = (box.min()[axis] - rounding - from[axis]) / along[axis];
    const double to_max = (box.max()[axis] + rounding - from[axis]) / along[axis];
    begin = std::max(begin, std::min(to_min, to_max));
    end = std::min(end, std::max(to_min, to_max));
  }
  return begin <= end;
}

enum class Ray { kEscapes, kIsHeld, kGrazes };

// Whether a ray crosses a surface, counted by the sense of the triangles: out of a closed one an
// odd number of times, however single triangles are turned.
Ray Follow(const std::vector<std::array<Eigen::Vector3d, 3>>& triangles, const BoxIndex& index,
           const Eigen::Vector3d& from, const Eigen::Vector3d& along) {
  int crossings = 0;
  bool grazed = false;
  const auto key = [&](const Eigen::AlignedBox3d& box) {
    return MayMeet(box, from, along) ? 0.0 : std::numeric_limits<double>::infinity();
  };
  index.Walk(key, [&](size_t i) {
    const auto& t = triangles[i];
    const Eigen::Vector3d a = t[0] - from, b = t[1] - from, c = t[2] - from;
    const double u = along.dot(b.cross(c)), v = along.dot(c.cross(a)), w = along.dot(a.cross(b));
    const bool out = u > 0 && v > 0 && w > 0, in = u < 0 && v < 0 && w < 0;
    if (!out && !in) {
      const bool grazes = (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
      grazed = grazed || (grazes && (u != 0 || v != 0 || w != 0));
      return;
    }
    // Ahead of the ray's origin where the triangle's plane is, seen along it.
    const double volume = a.dot(b.cross(c));
    if (out ? volume > 0 : volume < 0) crossings += out ? 1 : -1;
  });
  if (grazed) return Ray::kGrazes;
  return crossings == 0 ? Ray::kEscapes : Ray::kIsHeld;
}

}  // namespace

Solid::Solid(const ConvexBody& body) {
  set_.points.assign(body.vertices.colwise().begin(), body.vertices.colwise().end());
  set_.disc = body.disc_radius;
  set_.ball = body.ball_radius;
  const Eigen::AlignedBox3d box = Bounds(set_);
  lower_ = box.min();
  upper_ = box.max();
  center_ = box.center();
  for (const Eigen::Vector3d& p : set_.points) radius_ = std::max(radius_, (p - center_).norm());
  radius_ += set_.disc + set_.ball + kBoundRounding;
}

Solid::Solid(const TriangleMesh& mesh) {
  for (const Eigen::Vector3i& t : mesh.triangles.colwise()) {
    triangles_.push_back(
        {mesh.vertices.col(t[0]), mesh.vertices.col(t[1]), mesh.vertices.col(t[2])});
  }
  index_ = BoxIndex(AroundEach(triangles_));
  if (!mesh.hollow) FindParts(mesh);
  Eigen::AlignedBox3d box;
  for (const Triangle& triangle : triangles_) box.extend(Around(triangle));
  const Eigen::Vector3d around = Eigen::Vector3d::Constant(kBoundRounding);
  lower_ = box.min() - around;
  upper_ = box.max() + around;
  center_ = 0.5 * (lower_ + upper_);
  radius_ = 0.5 * (upper_ - lower_).norm() * (1 + 1e-12);
}

// Parts are joined by corners in the same place: an STL file does not say which are the same. A
// triangle that is there twice counts once: turned both ways it would let every ray escape.
void Solid::FindParts(const TriangleMesh& mesh) {
  std::map<std::array<double, 3>, int> places;
  std::vector<int> place, parent;
  for (const Eigen::Vector3d& v : mesh.vertices.colwise()) {
    const auto [found, fresh] =
        places.try_emplace({v.x(), v.y(), v.z()}, static_cast<int>(parent.size()));
    if (fresh) parent.push_back(found->second);
    place.push_back(found->second);
  }
  const auto root = [&](int i) {
    while (Nth(parent, i) != i) {
      int& up = Nth(parent, i);
      up = Nth(parent, up);
      i = up;
    }
    return i;
  };
  for (const Eigen::Vector3i& t : mesh.triangles.colwise()) {
    const int first = root(Nth(place, t[0]));
    Nth(parent, root(Nth(place, t[1]))) = first;
    Nth(parent, root(Nth(place, t[2]))) = first;
  }
  std::map<int, size_t> part_of;
  std::set<std::array<int, 3>> seen;
  for (Eigen::Index i = 0; i < mesh.triangles.cols(); ++i) {
    std::array<int, 3> corners{};
    for (Eigen::Index k = 0; k < 3; ++k) {
      Nth(corners, k) = Nth(place, mesh.triangles(k, i));
    }
    std::ranges::sort(corners);
    if (!seen.insert(corners).second) continue;
    const int its = root(Nth(place, mesh.triangles(0, i)));
    const auto [found, fresh] = part_of.try_emplace(its, parts_.size());
    if (fresh) parts_.emplace_back();
    parts_[found->second].triangles.push_back(Nth(triangles_, i));
  }
  std::vector<Eigen::AlignedBox3d> around;
  for (Part& part : parts_) {
    Eigen::AlignedBox3d box;
    for (const Triangle& triangle : part.triangles) box.extend(Around(triangle));
    around.push_back(box);
    part.index = BoxIndex(AroundEach(part.triangles));
  }
  around_parts_ = BoxIndex(std::move(around));
}

double Solid::FromTriangles(const ConvexSet& set, const Eigen::AlignedBox3d& bounds) const {
  double least = std::numeric_limits<double>::infinity();
  const auto key = [&](const Eigen::AlignedBox3d& box) {
    const double far = std::sqrt(box.squaredExteriorDistance(bounds));
    return far >= least ? std::numeric_limits<double>::infinity() : far;
  };
  index_.Walk(key, [&](size_t i) {
    const ConvexSet triangle{{triangles_[i].begin(), triangles_[i].end()}};
    least = std::min(least, DistanceOf(set, triangle, least).lower);
  });
  return least;
}

// Rays into all octants, none in line with the axes. A closed part holds every one; one that comes
// too near to an edge to tell does not escape.
bool Solid::Surrounds(const Eigen::Vector3d& point) const {
  const std::array<Eigen::Vector3d, 8> rays = {
      Eigen::Vector3d(1, 0.937, 1.071),       Eigen::Vector3d(-1.013, -0.959, 1.117),
      Eigen::Vector3d(-0.947, 1.039, 0.893),  Eigen::Vector3d(1.049, -1.103, 0.983),
      Eigen::Vector3d(1.021, 0.913, -1.129),  Eigen::Vector3d(-1.087, -0.929, -0.971),
      Eigen::Vector3d(-0.967, 1.061, -1.093), Eigen::Vector3d(1.091, -0.991, -0.919)};
  // Beside the bounds of a part some ray leads away from it.
  const std::vector<size_t> near = around_parts_.Meeting({point, point});
  return std::any_of(near.begin(), near.end(), [&](size_t p) {
    return std::none_of(rays.begin(), rays.end(), [&](const Eigen::Vector3d& ray) {
      return Follow(parts_[p].triangles, parts_[p].index, point, ray) == Ray::kEscapes;
    });
  });
}

double Solid::Distance(const Solid& convex, const Eigen::Isometry3d& X_Wa, const Solid& other,
                       const Eigen::Isometry3d& X_Wb) {
  const ConvexSet seen = Moved(X_Wb.inverse(Eigen::Isometry) * X_Wa, convex.set_);
  if (!other.set_.points.empty()) return DistanceOf(seen, other.set_).lower;
  const double distance = other.FromTriangles(seen, Bounds(seen));
  const Eigen::Vector3d& point = seen.points[0];
  const bool near = (point.array() >= other.lower_.array()).all() &&
                    (point.array() <= other.upper_.array()).all();
  return distance > 0 && near && other.Surrounds(point) ? 0 : distance;
}

}  // namespace halfstep::verify
