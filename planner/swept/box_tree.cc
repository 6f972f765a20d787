#include "planner/swept/box_tree.h"

#include <limits>

#include "wpg/nth.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

using CellBox = BoxTree::CellBox;

CellBox ChildBox(const BoxNode& node, int c) {
  return {{node.lower[0][c], node.lower[1][c], node.lower[2][c]},
          {node.upper[0][c], node.upper[1][c], node.upper[2][c]}};
}

}  // namespace

bool BoxTree::IsSound() const {
  const int count = static_cast<int>(nodes.size());
  std::vector<bool> named(nodes.size(), false);
  std::vector<int> level(nodes.size(), 1);
  for (int i = 0; i < count; ++i) {
    if (i > 0 && !Nth(named, i)) return false;
    const BoxNode& node = Nth(nodes, i);
    for (int c = 0; c < 4; ++c) {
      const int32_t child = node.child[c];
      const CellBox box = ChildBox(node, c);
      const bool turned = (box.lower.array() >= box.upper.array()).any();
      if (child == BoxNode::kAbsent) {
        if (!(box.lower.array() > box.upper.array()).all()) return false;
        continue;
      }
      if (turned) return false;
      if (child == BoxNode::kSolid) continue;
      if (child <= i || child >= count || Nth(named, child)) return false;
      Nth(named, child) = true;
      Nth(level, child) = Nth(level, i) + 1;
      if (3 * Nth(level, child) + 1 > kStack) return false;
      for (int g = 0; g < 4; ++g) {
        const BoxNode& inner = Nth(nodes, child);
        if (inner.child[g] == BoxNode::kAbsent) continue;
        const CellBox inside = ChildBox(inner, g);
        if ((inside.lower.array() < box.lower.array()).any() ||
            (inside.upper.array() > box.upper.array()).any()) {
          return false;
        }
      }
    }
  }
  return true;
}

std::vector<CellBox> BoxTree::SolidBoxes() const {
  std::vector<CellBox> boxes;
  for (const BoxNode& node : nodes) {
    for (int c = 0; c < 4; ++c) {
      if (node.child[c] == BoxNode::kSolid) boxes.push_back(ChildBox(node, c));
    }
  }
  return boxes;
}

Vector3d BoxTree::Lower() const {
  Vector3i lower = Vector3i::Constant(65536);
  for (int c = 0; c < 4 && !nodes.empty(); ++c) {
    if (nodes[0].child[c] != BoxNode::kAbsent) lower = lower.cwiseMin(ChildBox(nodes[0], c).lower);
  }
  return Corner(lower);
}

Vector3d BoxTree::Upper() const {
  Vector3i upper = Vector3i::Zero();
  for (int c = 0; c < 4 && !nodes.empty(); ++c) {
    if (nodes[0].child[c] != BoxNode::kAbsent) upper = upper.cwiseMax(ChildBox(nodes[0], c).upper);
  }
  return Corner(upper);
}

double BoxTree::Volume() const {
  int64_t cells = 0;
  for (const CellBox& box : SolidBoxes()) cells += box.Cells();
  return static_cast<double>(cells) * cell * cell * cell;
}

bool BoxTree::Contains(const Vector3d& p) const {
  const Vector3d at = (p - origin) / cell;
  std::vector<int32_t> stack;
  if (!nodes.empty()) stack.push_back(0);
  while (!stack.empty()) {
    const BoxNode& node = Nth(nodes, stack.back());
    stack.pop_back();
    for (int c = 0; c < 4; ++c) {
      const CellBox box = ChildBox(node, c);
      if ((at.array() < box.lower.cast<double>().array()).any() ||
          (at.array() > box.upper.cast<double>().array()).any()) {
        continue;
      }
      if (node.child[c] == BoxNode::kSolid) return true;
      if (node.child[c] >= 0) stack.push_back(node.child[c]);
    }
  }
  return false;
}

}  // namespace halfstep
