#include "planner/collision/mesh_patches.h"

#include <algorithm>
#include <array>
#include <boost/pending/disjoint_sets.hpp>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "wpg/nth.h"

namespace halfstep {
namespace {

using Corners = std::array<int32_t, 3>;

// The number of a vertex equal to each vertex, the same for all that are equal.
std::vector<int32_t> Welded(const Eigen::Matrix3Xd& vertices) {
  std::vector<int32_t> order(static_cast<size_t>(vertices.cols()));
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int32_t i) {
    return std::tuple(vertices(0, i), vertices(1, i), vertices(2, i));
  };
  std::sort(order.begin(), order.end(), [&](int32_t a, int32_t b) { return key(a) < key(b); });
  std::vector<int32_t> welded(order.size());
  for (size_t i = 0; i < order.size(); ++i) {
    const bool again = i > 0 && key(order[i]) == key(order[i - 1]);
    Nth(welded, order[i]) = again ? Nth(welded, order[i - 1]) : order[i];
  }
  return welded;
}

// The triangles by welded corners, without those with two equal corners, each once.
std::vector<Corners> DifferentTriangles(const TriangleMesh& mesh) {
  const std::vector<int32_t> welded = Welded(mesh.vertices);
  std::vector<std::pair<Corners, Corners>> all;  // sorted corners, corners in order
  for (const Eigen::Vector3i& t : mesh.triangles.colwise()) {
    Corners corners{};
    for (int k = 0; k < 3; ++k) {
      Nth(corners, k) = Nth(welded, t[k]);
    }
    Corners sorted = corners;
    std::sort(sorted.begin(), sorted.end());
    if (sorted[0] != sorted[1] && sorted[1] != sorted[2]) all.emplace_back(sorted, corners);
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Corners> different;
  for (size_t i = 0; i < all.size(); ++i) {
    if (i == 0 || all[i].first != all[i - 1].first) different.push_back(all[i].second);
  }
  return different;
}

// The other triangle at an edge that two triangles have.
struct Neighbour {
  int32_t triangle = -1;  // −1: the edge has one triangle, or more than two.
  bool turned = false;    // both run through the edge the same way
};

std::vector<std::array<Neighbour, 3>> FindNeighbours(const std::vector<Corners>& triangles) {
  struct HalfEdge {
    int32_t low, high, triangle;
    int8_t side;
    bool upwards;
  };
  std::vector<HalfEdge> edges;
  for (size_t t = 0; t < triangles.size(); ++t) {
    for (size_t k = 0; k < 3; ++k) {
      const int32_t from = triangles[t][k], to = triangles[t][(k + 1) % 3];
      edges.push_back({std::min(from, to), std::max(from, to), static_cast<int32_t>(t),
                       static_cast<int8_t>(k), from < to});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::tuple(a.low, a.high, a.triangle) < std::tuple(b.low, b.high, b.triangle);
  });
  std::vector<std::array<Neighbour, 3>> neighbours(triangles.size());
  for (size_t i = 0, end = 0; i < edges.size(); i = end) {
    for (end = i; end < edges.size() && edges[end].low == edges[i].low &&
                  edges[end].high == edges[i].high;) {
      ++end;
    }
    if (end - i != 2) continue;
    const HalfEdge &a = edges[i], &b = edges[i + 1];
    const bool turned = a.upwards == b.upwards;
    Nth(Nth(neighbours, a.triangle), a.side) = {b.triangle, turned};
    Nth(Nth(neighbours, b.triangle), b.side) = {a.triangle, turned};
  }
  return neighbours;
}

MeshPatch MakePatch(const Eigen::Matrix3Xd& vertices, const std::vector<Corners>& triangles,
                    bool closed) {
  MeshPatch patch{.mesh = {}, .closed = closed};
  std::unordered_map<int32_t, int> own;
  std::vector<int32_t> used;
  patch.mesh.triangles.resize(3, static_cast<Eigen::Index>(triangles.size()));
  for (size_t t = 0; t < triangles.size(); ++t) {
    for (size_t k = 0; k < 3; ++k) {
      const auto [at, fresh] = own.try_emplace(triangles[t][k], static_cast<int>(used.size()));
      if (fresh) used.push_back(triangles[t][k]);
      patch.mesh.triangles(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(t)) = at->second;
    }
  }
  patch.mesh.vertices.resize(3, static_cast<Eigen::Index>(used.size()));
  for (size_t i = 0; i < used.size(); ++i) {
    patch.mesh.vertices.col(static_cast<Eigen::Index>(i)) = vertices.col(used[i]);
  }
  return patch;
}

}  // namespace

std::vector<MeshPatch> FindPatches(const TriangleMesh& mesh) {
  const std::vector<Corners> triangles = DifferentTriangles(mesh);
  const std::vector<std::array<Neighbour, 3>> neighbours = FindNeighbours(triangles);
  std::vector<MeshPatch> patches;
  std::vector<int8_t> sign(triangles.size(), 0);  // 0: in no patch yet
  for (size_t seed = 0; seed < triangles.size(); ++seed) {
    if (sign[seed] != 0) continue;
    std::vector<size_t> members = {seed};
    sign[seed] = 1;
    bool closed = true, orientable = true;
    int64_t sum = 0;
    for (size_t i = 0; i < members.size(); ++i) {
      const size_t t = members[i];
      sum += sign[t];
      for (const Neighbour& n : neighbours[t]) {
        if (n.triangle < 0) {
          closed = false;
          continue;
        }
        const size_t next = static_cast<size_t>(n.triangle);
        const int8_t alike = n.turned ? static_cast<int8_t>(-sign[t]) : sign[t];
        if (sign[next] == 0) {
          sign[next] = alike;
          members.push_back(next);
        } else if (sign[next] != alike) {
          orientable = false;
        }
      }
    }
    std::vector<Corners> all;
    for (const size_t t : members) {
      Corners corners = triangles[t];
      if (orientable && sign[t] != (sum < 0 ? -1 : 1)) std::swap(corners[1], corners[2]);
      all.push_back(corners);
      if (orientable) continue;
      patches.push_back(MakePatch(mesh.vertices, all, false));
      all.clear();
    }
    if (orientable) patches.push_back(MakePatch(mesh.vertices, all, closed));
  }
  return patches;
}

std::vector<Eigen::Vector3d> CornerOfEachPart(const TriangleMesh& mesh) {
  boost::disjoint_sets_with_storage<> parts(static_cast<size_t>(mesh.vertices.cols()));
  for (const Eigen::Vector3i& t : mesh.triangles.colwise()) {
    parts.union_set(t[0], t[1]);
    parts.union_set(t[0], t[2]);
  }
  std::vector<Eigen::Vector3d> corners;
  std::vector<bool> told(static_cast<size_t>(mesh.vertices.cols()), false);
  for (const Eigen::Vector3i& t : mesh.triangles.colwise()) {
    const int part = parts.find_set(t[0]);
    if (!Nth(told, part)) corners.emplace_back(mesh.vertices.col(t[0]));
    Nth(told, part) = true;
  }
  return corners;
}

}  // namespace halfstep
