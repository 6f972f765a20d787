#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "wpg/nth.h"

namespace halfstep {

/// A tree of boxes along the axes over items that are known by their own such boxes, so that a
/// question about a place looks at what is near it only. Node 0 is the root; children come after
/// their parents. No node for no item.
struct BoundsTree {
  /// A box, and the nodes or items in it.
  struct Node {
    Eigen::Vector3d center, half;  ///< a box that holds those of all its items [m]
    int32_t left = -1;             ///< the children are nodes left and left + 1; −1: a leaf
    int32_t first = 0, count = 0;  ///< its items: order[first] … order[first + count − 1]
  };
  std::vector<Node> nodes;     ///< empty for no item
  std::vector<int32_t> order;  ///< indices of the items, leaf by leaf

  BoundsTree() = default;
  /// A leaf holds at most `leaf` ≥ 1 items. Precondition: finite boxes that are not empty
  /// (std::logic_error).
  BoundsTree(const std::vector<Eigen::AlignedBox3d>& boxes, int32_t leaf);

  /// Distance of a point from the box of a node, 0 inside, by no more than the rounding of
  /// coordinates too large [m].
  static double Gap(const Node& node, const Eigen::Vector3d& p) {
    return ((p - node.center).cwiseAbs() - node.half).cwiseMax(0.0).norm();
  }

  /// Calls visit(item) for every item of the leaves whose boxes are within `reach` [m] of a point:
  /// for all items that are, and some that are not.
  template <typename Visit>
  void ForEachNear(const Eigen::Vector3d& p, double reach, const Visit& visit) const {
    if (nodes.empty()) return;
    const double widened = reach + 1e-12 * (1.0 + p.cwiseAbs().sum() + Farthest());
    int32_t stack[kDeepest];
    int top = 0;
    stack[top++] = 0;
    while (top > 0) {
      const Node& node = Nth(nodes, stack[--top]);
      if (!(Gap(node, p) <= widened)) continue;
      if (node.left >= 0) {
        stack[top++] = node.left + 1;
        stack[top++] = node.left;
        continue;
      }
      for (int32_t i = node.first; i < node.first + node.count; ++i) {
        visit(Nth(order, i));
      }
    }
  }

  /// A coordinate that none of the items exceeds [m].
  double Farthest() const {
    return nodes.empty() ? 0.0 : (nodes[0].center.cwiseAbs() + nodes[0].half).maxCoeff();
  }

  /// Nodes on the stack of a depth-first walk: halving 2³¹ items takes 31 levels.
  static constexpr int kDeepest = 64;
};

}  // namespace halfstep
