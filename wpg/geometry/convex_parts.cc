#include "wpg/geometry/convex_parts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "wpg/geometry/planar_hull.h"

namespace halfstep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Triangle = std::array<Vector3d, 3>;

constexpr double kLeastSaving = 0.01;  // of the volume of the mesh's hull
constexpr double kRounding = 1e-12;    // of the coordinates: what corners on cuts may be off
constexpr int kPlaces = 8;             // of cuts along an axis: at multiples of 1/8 of the size

// A part of the mesh's surface, closed where it was cut, and its hull.
struct Part {
  std::vector<Triangle> surface;
  ConvexBody hull;
  double volume = 0.0;  // of the hull [m³]
};

double VolumeOf(const ConvexBody& hull) {
  double volume = 0.0;
  for (const Eigen::Vector3i& face : hull.triangles) {
    const Vector3d a = hull.vertices.col(face[0]) - hull.center,
                   b = hull.vertices.col(face[1]) - hull.center,
                   c = hull.vertices.col(face[2]) - hull.center;
    volume += a.dot(b.cross(c)) / 6;
  }
  return volume;
}

Part PartOf(std::vector<Triangle> surface) {
  Eigen::Matrix3Xd points(3, 3 * static_cast<Eigen::Index>(surface.size()));
  Eigen::Index n = 0;
  for (const Triangle& triangle : surface) {
    for (const Vector3d& corner : triangle) points.col(n++) = corner;
  }
  Part part;
  part.hull = MakeHull(points);
  part.volume = VolumeOf(part.hull);
  part.surface = std::move(surface);
  return part;
}

// The part of a triangle where sign·x[axis] ≤ sign·place, as triangles, onto the end of `kept`, and
// its corners in the plane onto `section`; nothing of a triangle that has no corner off the plane
// on that side.
void Clip(const Triangle& triangle, int axis, double place, double sign,
          std::vector<Triangle>* kept, std::vector<Vector3d>* section) {
  if (std::all_of(triangle.begin(), triangle.end(),
                  [&](const Vector3d& corner) { return sign * (corner[axis] - place) >= 0; })) {
    return;
  }
  std::array<Vector3d, 4> corners;
  size_t n = 0;
  for (size_t i = 0; i < 3; ++i) {
    const Vector3d &a = triangle[i], &b = triangle[(i + 1) % 3];
    const double over_a = sign * (a[axis] - place), over_b = sign * (b[axis] - place);
    if (over_a <= 0) {
      corners[n++] = a;
      if (over_a == 0) section->push_back(a);
    }
    if ((over_a < 0 && over_b > 0) || (over_a > 0 && over_b < 0)) {
      Vector3d on = a + (over_a / (over_a - over_b)) * (b - a);
      on[axis] = place;
      corners[n++] = on;
      section->push_back(on);
    }
  }
  for (size_t i = 2; i < n; ++i) kept->push_back({corners[0], corners[i - 1], corners[i]});
}

// The hull of points in the plane x[axis] = place, as triangles, onto the end of `surface`.
void Close(const std::vector<Vector3d>& section, int axis, double place,
           std::vector<Triangle>* surface) {
  if (section.size() < 3) return;
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::vector<Vector2d> points, corners(2 * section.size() + 1);
  for (const Vector3d& point : section) points.emplace_back(point[u], point[v]);
  corners.resize(PlanarHull(points, corners));
  const auto at = [&](const Vector2d& corner) {
    Vector3d point;
    point[axis] = place;
    point[u] = corner.x();
    point[v] = corner.y();
    return point;
  };
  for (size_t i = 2; i < corners.size(); ++i) {
    surface->push_back({at(corners[0]), at(corners[i - 1]), at(corners[i])});
  }
}

// Both sides of a cut; triangles in the plane go to one of them. None where a side is flat or
// empty.
std::optional<std::array<Part, 2>> Cut(const Part& part, int axis, double place,
                                       const std::vector<Triangle>& in_plane, size_t their_side) {
  std::array<Part, 2> sides;
  for (size_t side = 0; side < 2; ++side) {
    std::vector<Triangle> surface;
    std::vector<Vector3d> section;
    for (const Triangle& triangle : part.surface) {
      Clip(triangle, axis, place, side == 0 ? 1.0 : -1.0, &surface, &section);
    }
    Close(section, axis, place, &surface);
    if (side == their_side) surface.insert(surface.end(), in_plane.begin(), in_plane.end());
    if (surface.size() < 2) return std::nullopt;
    try {
      sides[side] = PartOf(std::move(surface));
    } catch (const std::runtime_error&) {
      return std::nullopt;
    }
  }
  return sides;
}

std::vector<Triangle> InPlane(const Part& part, int axis, double place) {
  std::vector<Triangle> found;
  for (const Triangle& triangle : part.surface) {
    if (std::all_of(triangle.begin(), triangle.end(),
                    [&](const Vector3d& corner) { return corner[axis] == place; })) {
      found.push_back(triangle);
    }
  }
  return found;
}

// The cut that leaves least volume; none that leaves at least `most` [m³].
std::optional<std::array<Part, 2>> BestCut(const Part& part, double most) {
  const Vector3d low = part.hull.vertices.rowwise().minCoeff(),
                 high = part.hull.vertices.rowwise().maxCoeff();
  std::optional<std::array<Part, 2>> best;
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 1; i < kPlaces; ++i) {
      const double place = low[axis] + (high[axis] - low[axis]) * i / kPlaces;
      const std::vector<Triangle> in_plane = InPlane(part, axis, place);
      for (size_t side = 0; side < (in_plane.empty() ? 1 : 2); ++side) {
        auto sides = Cut(part, axis, place, in_plane, side);
        if (!sides) continue;
        const double volume = (*sides)[0].volume + (*sides)[1].volume;
        if (volume >= most) continue;
        most = volume;
        best = std::move(sides);
      }
    }
  }
  return best;
}

}  // namespace

std::vector<ConvexBody> CutIntoConvexParts(const Eigen::Matrix3Xd& vertices,
                                           const Eigen::Matrix3Xi& triangles, int parts) {
  if (parts < 1) throw std::logic_error("CutIntoConvexParts: parts = " + std::to_string(parts));
  // A part and the best cut of it.
  struct Candidate {
    Part part = {};
    std::optional<std::array<Part, 2>> cut = {};
    double saving = 0.0;  // [m³]
  };
  double least = 0.0;
  const auto candidate_of = [&least](Part part) {
    Candidate candidate{.part = std::move(part)};
    candidate.cut = BestCut(candidate.part, candidate.part.volume - least);
    if (candidate.cut) {
      candidate.saving =
          candidate.part.volume - (*candidate.cut)[0].volume - (*candidate.cut)[1].volume;
    }
    return candidate;
  };
  std::vector<Triangle> surface;
  for (const auto& triangle : triangles.colwise()) {
    surface.push_back(
        {vertices.col(triangle[0]), vertices.col(triangle[1]), vertices.col(triangle[2])});
  }
  Part whole = PartOf(std::move(surface));
  const double rounding = kRounding * whole.hull.vertices.cwiseAbs().maxCoeff();
  least = kLeastSaving * whole.volume;
  std::vector<Candidate> all;
  all.push_back(parts == 1 ? Candidate{.part = std::move(whole)} : candidate_of(std::move(whole)));
  while (static_cast<int>(all.size()) < parts) {
    const auto next = std::max_element(
        all.begin(), all.end(), [](const auto& a, const auto& b) { return a.saving < b.saving; });
    if (!next->cut) break;
    std::array<Part, 2> sides = std::move(*next->cut);
    all.erase(next);
    for (Part& side : sides) all.push_back(candidate_of(std::move(side)));
  }
  std::vector<ConvexBody> bodies;
  for (Candidate& candidate : all) {
    ConvexBody& hull = bodies.emplace_back(std::move(candidate.part.hull));
    if (all.size() > 1) hull.ball_radius += rounding;
    BoundBySphere(&hull);
  }
  return bodies;
}

}  // namespace halfstep
