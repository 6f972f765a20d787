#include "planner/collision/mesh_winding.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numbers>
#include <utility>

#include "wpg/elementary.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

// Half the solid angle of a triangle seen from the origin. Source: [VanOosterom1983].
double HalfAngle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return Atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

}  // namespace

MeshWinding::MeshWinding(const TriangleTree& tree) {
  std::map<Corner, int32_t> index;
  const auto corner = [&](const Vector3d& p) {
    const auto [at, fresh] =
        index.try_emplace({p.x(), p.y(), p.z()}, static_cast<int32_t>(corners_.size()));
    if (fresh) corners_.push_back(at->first);
    return at->second;
  };
  // How often each edge is run through upwards less downwards, of the nodes whose parent is not
  // done. Children come after their parents.
  using Counts = std::map<std::pair<int32_t, int32_t>, int32_t>;
  const auto count = [](Counts* counts, int32_t from, int32_t to, int32_t times) {
    if (from == to) return;
    if (from > to) {
      std::swap(from, to);
      times = -times;
    }
    const auto at = counts->try_emplace({from, to}, 0).first;
    at->second += times;
    if (at->second == 0) counts->erase(at);
  };
  std::vector<Counts> pending(tree.nodes.size());
  std::vector<int32_t> triangles(tree.nodes.size());
  borders_.resize(tree.nodes.size());
  for (size_t n = tree.nodes.size(); n-- > 0;) {
    const TriangleTree::Node& node = tree.nodes[n];
    if (node.left < 0) {
      triangles[n] = node.count;
      for (int32_t i = node.first; i < node.first + node.count; ++i) {
        const Eigen::Matrix3d& t = Nth(tree.triangles, i);
        const int32_t k[3] = {corner(t.col(0)), corner(t.col(1)), corner(t.col(2))};
        for (int e = 0; e < 3; ++e) count(&pending[n], k[e], k[(e + 1) % 3], 1);
      }
    } else {
      Counts &left = Nth(pending, node.left), &right = Nth(pending, node.left + 1);
      triangles[n] = Nth(triangles, node.left) + Nth(triangles, node.left + 1);
      if (left.size() < right.size()) std::swap(left, right);
      pending[n] = std::move(left);
      for (const auto& [edge, times] : right) {
        count(&pending[n], edge.first, edge.second, times);
      }
      right.clear();
    }
    // A cap as large as the part itself gains nothing.
    if (2 * std::ssize(pending[n]) >= triangles[n]) continue;
    borders_[n] = {static_cast<int32_t>(edges_.size()), static_cast<int32_t>(pending[n].size())};
    for (const auto& [edge, times] : pending[n]) edges_.push_back({edge.first, edge.second, times});
  }
}

double MeshWinding::At(const TriangleTree& tree, const Vector3d& point) const {
  const auto seen = [&](int32_t corner) -> Vector3d {
    const Corner& p = Nth(corners_, corner);
    return Vector3d(p[0], p[1], p[2]) - point;
  };
  double half_angles = 0.0;
  std::vector<int32_t> stack = {0};
  while (!stack.empty()) {
    const TriangleTree::Node& node = Nth(tree.nodes, stack.back());
    const Border& border = Nth(borders_, stack.back());
    stack.pop_back();
    const bool outside = ((point - node.center).cwiseAbs().array() > node.half.array()).any();
    if (outside && border.count >= 0) {
      if (border.count == 0) continue;
      // The cap: a fan over the border, in the hull of the part.
      const Edge* edges = &Nth(edges_, border.first);
      const Vector3d tip = seen(edges[0].from);
      for (int32_t e = 0; e < border.count; ++e) {
        if (edges[e].from == edges[0].from || edges[e].to == edges[0].from) continue;
        half_angles += edges[e].times * HalfAngle(tip, seen(edges[e].from), seen(edges[e].to));
      }
    } else if (node.left >= 0) {
      stack.push_back(node.left);
      stack.push_back(node.left + 1);
    } else {
      for (int32_t i = node.first; i < node.first + node.count; ++i) {
        const Eigen::Matrix3d t = Nth(tree.triangles, i).colwise() - point;
        half_angles += HalfAngle(t.col(0), t.col(1), t.col(2));
      }
    }
  }
  return half_angles / (2 * std::numbers::pi);
}

}  // namespace halfstep
