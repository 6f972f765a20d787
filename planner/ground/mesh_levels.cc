#include "planner/ground/mesh_levels.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr double kFacesUp = 0.985;        // cosine of 10°
constexpr double kLeastLevelArea = 0.01;  // of a level [m²]
constexpr double kBelow = 1e-3;           // of a slab below its band [m]
constexpr size_t kMostMeshLevels = 1000;

using PlanePoint = std::pair<double, double>;  // x and y in whole nanometres [m]

// A polygon, counter-clockwise, and the triangles that it was made of.
struct Ring {
  std::vector<PlanePoint> corners;
  std::vector<Eigen::Index> triangles;
};

struct Flat {
  Eigen::Index triangle;
  double area, top, bottom;
};

std::vector<Flat> FlatOf(const Eigen::Matrix3Xd& vertices_W, const Eigen::Matrix3Xi& triangles,
                         double tolerance) {
  std::vector<Flat> flat;
  for (Eigen::Index i = 0; i < triangles.cols(); ++i) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = vertices_W.col(triangles(k, i));
    const Eigen::Vector3d a = corners.col(1) - corners.col(0), b = corners.col(2) - corners.col(0);
    const Eigen::Vector3d doubled = a.cross(b);
    const double top = corners.row(2).maxCoeff(), bottom = corners.row(2).minCoeff();
    if (doubled.z() > kFacesUp * doubled.norm() && top - bottom <= tolerance) {
      flat.push_back({i, 0.5 * doubled.norm(), top, bottom});
    }
  }
  return flat;
}

// The upper end of the band that holds most area, and how much that is.
std::pair<double, double> FullestBand(const std::vector<Flat>& flat, double tolerance) {
  // Where a triangle comes into the band as its end rises, and where it leaves; comers first.
  std::vector<std::pair<double, double>> events;
  for (const Flat& f : flat) {
    events.emplace_back(f.top, -f.area);
    events.emplace_back(f.bottom + tolerance, f.area);
  }
  std::sort(events.begin(), events.end());
  double sum = 0.0, most = 0.0, end = 0.0;
  for (const auto& [at, loss] : events) {
    sum -= loss;
    if (sum > most) {
      most = sum;
      end = at;
    }
  }
  return {end, most};
}

double Turn(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return (b.first - a.first) * (c.second - b.second) - (b.second - a.second) * (c.first - b.first);
}

// The ring around two that share the edge at `i` of `a`, which is that at `k` of `b` reversed; none
// where it is not convex.
std::optional<std::vector<PlanePoint>> JoinedRing(const std::vector<PlanePoint>& a, size_t i,
                                                  const std::vector<PlanePoint>& b, size_t k) {
  std::vector<PlanePoint> ring;
  for (size_t j = 1; j <= a.size(); ++j) ring.push_back(a[(i + j) % a.size()]);
  for (size_t j = 2; j < b.size(); ++j) ring.push_back(b[(k + j) % b.size()]);
  const size_t n = ring.size();
  for (const size_t j : {size_t{0}, a.size() - 1}) {
    if (Turn(ring[(j + n - 1) % n], ring[j], ring[(j + 1) % n]) < 0.0) return std::nullopt;
  }
  return ring;
}

size_t EdgeAt(const std::vector<PlanePoint>& ring, const PlanePoint& from, const PlanePoint& to) {
  for (size_t i = 0; i < ring.size(); ++i) {
    if (ring[i] == from && ring[(i + 1) % ring.size()] == to) return i;
  }
  return ring.size();
}

// Fewer convex rings, which cover the same: neighbours are joined across their edges while that is
// convex, in the order of the edges.
std::vector<Ring> JoinedConvex(std::vector<Ring> rings) {
  std::map<std::pair<PlanePoint, PlanePoint>, size_t> beside;  // which ring has an edge
  for (size_t r = 0; r < rings.size(); ++r) {
    const std::vector<PlanePoint>& corners = rings[r].corners;
    for (size_t i = 0; i < corners.size(); ++i) {
      beside[{corners[i], corners[(i + 1) % corners.size()]}] = r;
    }
  }
  std::vector<size_t> into(rings.size());
  std::iota(into.begin(), into.end(), size_t{0});
  const auto find = [&into](size_t r) {
    while (into[r] != r) r = into[r] = into[into[r]];
    return r;
  };
  for (const auto& [edge, first] : beside) {
    const auto other = beside.find({edge.second, edge.first});
    if (edge.second < edge.first || other == beside.end()) continue;
    const size_t a = find(first), b = find(other->second);
    if (a == b) continue;
    Ring &one = rings[a], &other_one = rings[b];
    const size_t i = EdgeAt(one.corners, edge.first, edge.second);
    const size_t k = EdgeAt(other_one.corners, edge.second, edge.first);
    if (i == one.corners.size() || k == other_one.corners.size()) continue;
    std::optional<std::vector<PlanePoint>> joined =
        JoinedRing(one.corners, i, other_one.corners, k);
    if (!joined) continue;
    one.corners = *std::move(joined);
    one.triangles.insert(one.triangles.end(), other_one.triangles.begin(),
                         other_one.triangles.end());
    other_one = {};
    into[b] = a;
  }
  std::erase_if(rings, [](const Ring& ring) { return ring.corners.empty(); });
  return rings;
}

}  // namespace

MeshLevels LevelsOf(const std::string& name, const Eigen::Matrix3Xd& vertices_W,
                    const Eigen::Matrix3Xi& triangles, double tolerance, double floor) {
  MeshLevels made;
  std::vector<bool> taken(static_cast<size_t>(triangles.cols()), false);
  std::vector<Flat> flat = FlatOf(vertices_W, triangles, tolerance);
  while (static_cast<size_t>(made.levels) < kMostMeshLevels) {
    const auto [top, area] = FullestBand(flat, tolerance);
    if (!(area >= kLeastLevelArea)) break;
    std::vector<Ring> rings;
    std::vector<Flat> left;
    for (const Flat& f : flat) {
      if (f.top > top || f.bottom + tolerance < top) {
        left.push_back(f);
        continue;
      }
      Ring ring{.corners = {}, .triangles = {f.triangle}};
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d p = vertices_W.col(triangles(k, f.triangle));
        ring.corners.emplace_back(WholeNanometres(p.x()), WholeNanometres(p.y()));
      }
      rings.push_back(std::move(ring));
    }
    for (const Ring& ring : JoinedConvex(std::move(rings))) {
      Eigen::Matrix2Xd polygon(2, static_cast<Eigen::Index>(ring.corners.size()));
      for (Eigen::Index i = 0; i < polygon.cols(); ++i) {
        polygon.col(i) << Nth(ring.corners, i).first, Nth(ring.corners, i).second;
      }
      // Slivers bear nothing, and stay as they are.
      if (!WhyNotConvex(CornersOf(polygon)).empty()) continue;
      for (const Eigen::Index i : ring.triangles) Nth(taken, i) = true;
      made.surfaces.push_back({.name = name + "_" + std::to_string(made.surfaces.size() + 1),
                               .polygon = polygon,
                               .height = top,
                               .bottom = std::max(top - tolerance - kBelow, floor)});
    }
    made.area += area;
    ++made.levels;
    flat = std::move(left);
  }
  for (Eigen::Index i = 0; i < triangles.cols(); ++i) {
    if (!Nth(taken, i)) made.kept.push_back(i);
  }
  return made;
}

}  // namespace halfstep
