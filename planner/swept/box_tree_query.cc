#include "planner/swept/box_tree_query.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>
#include <vector>

#include "wpg/nth.h"

namespace halfstep {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Visits the solid boxes that the placed box meets until `accept(node, child)` is true.
template <typename Accept>
bool Descend(const BoxTree& tree, const BoxNode* root, const LatticeBoxTest& test,
             const Accept& accept) {
  if (tree.nodes.empty()) return false;
  int32_t stack[BoxTree::kStack];
  int top = 0;
  const BoxNode* next = root != nullptr ? root : tree.nodes.data();
  while (true) {
    const BoxNode& node = *next;
    for (int hits = test.Hits(node); hits != 0; hits &= hits - 1) {
      const int c = std::countr_zero(static_cast<unsigned>(hits));
      const int32_t child = node.child[c];
      if (child >= 0) {
        stack[top++] = child;
        __builtin_prefetch(&Nth(tree.nodes, child));
      } else if (child == BoxNode::kSolid && accept(node, c)) {
        return true;
      }
    }
    if (top == 0) return false;
    next = &Nth(tree.nodes, stack[--top]);
  }
}

struct Bounds {
  Vector3d lower, upper;
};
Bounds ChildBounds(const BoxTree& tree, const BoxNode& node, int c, double extra) {
  const auto corner = [&](const uint16_t(&of)[3][4]) {
    return tree.Corner({of[0][c], of[1][c], of[2][c]});
  };
  return {corner(node.lower).array() - extra, corner(node.upper).array() + extra};
}

// Whether the body meets an axis-aligned box. Alternating projections between box and core (the
// body without its ball) come to the nearest points; each gives a distance that is not below the
// true one and a slab that is not above it.
bool MeetsBox(const RoundBody& body, const Vector3d& center, const Matrix3d& axes,
              const Bounds& box) {
  constexpr int kProjections = 64;
  constexpr double kRounding = 1e-9;  // [m]
  const double reach = body.ball_radius + kRounding;
  Vector3d in_core = center;
  for (int i = 0; i < kProjections; ++i) {
    const Vector3d in_box = in_core.cwiseMax(box.lower).cwiseMin(box.upper);
    // The box ends at in_box along the way from it to the core; where does the core begin?
    const Vector3d away = in_core - in_box;
    const double distance = away.norm();
    if (distance <= reach) return true;
    const Vector3d away_O = axes.transpose() * away;
    const double begins = away.dot(center) - body.half_length * std::abs(away_O.z()) -
                          body.disc_radius * away_O.head<2>().norm();
    if (begins - away.dot(in_box) > reach * distance) return false;
    Vector3d p_O = axes.transpose() * (in_box - center);
    p_O.z() = std::clamp(p_O.z(), -body.half_length, body.half_length);
    const double radial = p_O.head<2>().norm();
    if (radial > body.disc_radius) p_O.head<2>() *= body.disc_radius / radial;
    in_core = center + axes * p_O;
  }
  return true;
}

}  // namespace

bool Meets(const BoxTree& tree, const OrientedBox& box, double extra, const BoxNode* root) {
  LatticeBoxTest test(tree, box.axes, extra);
  test.Place(box.center, box.half);
  return Descend(tree, root, test, [](const BoxNode&, int) { return true; });
}

bool Meets(const BoxTree& tree, const RoundBody& body, const Vector3d& center, const Matrix3d& axes,
           double extra, const BoxNode* root) {
  LatticeBoxTest test(tree, axes, extra);
  const double across = body.disc_radius + body.ball_radius;
  test.Place(center, {across, across, body.half_length + body.ball_radius});
  return Descend(tree, root, test, [&](const BoxNode& node, int c) {
    return MeetsBox(body, center, axes, ChildBounds(tree, node, c, extra));
  });
}

bool Meets(const BoxTree& tree, const TriangleTree& mesh, const Vector3d& origin,
           const Matrix3d& axes, double extra) {
  if (tree.nodes.empty()) return false;
  LatticeBoxTest test(tree, axes, extra);
  const auto meets_triangle = [&](const TriangleTree::Node& leaf, const BoxNode& node, int c) {
    const Bounds box = ChildBounds(tree, node, c, extra);
    const Vector3d middle = 0.5 * (box.lower + box.upper);
    const Vector3d half = 0.5 * (box.upper - box.lower).array() + 1e-9;
    for (int32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
      const Matrix3d corners = (axes * Nth(mesh.triangles, i)).colwise() + (origin - middle);
      if (TriangleMeetsBox(corners, half)) return true;
    }
    return false;
  };
  struct Pair {
    int32_t triangles, boxes;
  };
  std::vector<Pair> stack = {{0, 0}};
  while (!stack.empty()) {
    const auto [m, n] = stack.back();
    stack.pop_back();
    const TriangleTree::Node& part = Nth(mesh.nodes, m);
    const BoxNode& node = Nth(tree.nodes, n);
    test.Place(origin + axes * part.center, part.half);
    const int hits = test.Hits(node);
    bool solid = false;
    int widest = 0;
    for (int left = hits; left != 0; left &= left - 1) {
      const int c = std::countr_zero(static_cast<unsigned>(left));
      solid = solid || node.child[c] == BoxNode::kSolid;
      for (int a = 0; a < 3; ++a) {
        if (node.child[c] >= 0) widest = std::max(widest, node.upper[a][c] - node.lower[a][c]);
      }
    }
    if (hits == 0) continue;
    if (part.left >= 0 && (solid || 2.0 * part.half.maxCoeff() > widest * tree.cell)) {
      stack.push_back({part.left, n});
      stack.push_back({part.left + 1, n});
      continue;
    }
    for (int left = hits; left != 0; left &= left - 1) {
      const int c = std::countr_zero(static_cast<unsigned>(left));
      const int32_t child = node.child[c];
      if (child >= 0) {
        stack.push_back({m, child});
      } else if (child == BoxNode::kSolid && meets_triangle(part, node, c)) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace halfstep
