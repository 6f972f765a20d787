#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <numeric>

#include "planner/swept/box_tree.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

using CellBox = BoxTree::CellBox;

// Bounds of the occupied cells of each slice across an axis; empty slices: lower > upper.
struct Slices {
  std::array<std::vector<CellBox>, 3> of;
  int64_t occupied = 0;
};

const CellBox kNothing{Vector3i::Constant(std::numeric_limits<int>::max()),
                       Vector3i::Constant(std::numeric_limits<int>::min())};

CellBox Join(const CellBox& a, const CellBox& b) {
  return {a.lower.cwiseMin(b.lower), a.upper.cwiseMax(b.upper)};
}

class Builder {
 public:
  explicit Builder(const VoxelGrid& grid) : grid_(grid) {}

  struct Branch {
    CellBox box;
    int left = -1, right = -1;  // both −1: solid
  };

  int Split(const CellBox& within, int depth) {
    const Slices slices = Slice(within);
    if (slices.occupied == 0) return -1;
    CellBox box = kNothing;
    for (const CellBox& slice : slices.of[0]) box = Join(box, slice);
    const int index = static_cast<int>(branches_.size());
    branches_.push_back({box});
    if (slices.occupied == box.Cells()) return index;
    // Halving ends within 48 more.
    const auto [axis, at] = depth < 36 ? BestCut(slices, within, box) : Halves(box);
    CellBox left = box, right = box;
    left.upper[axis] = right.lower[axis] = at;
    const int l = Split(left, depth + 1), r = Split(right, depth + 1);
    Nth(branches_, index).left = l;
    Nth(branches_, index).right = r;
    return index;
  }

  // Four children a node: the largest are opened first.
  int Emit(int branch, std::vector<BoxNode>* nodes) const {
    std::vector<int> open = {At(branch).left, At(branch).right};
    if (At(branch).left < 0) open = {branch};
    while (open.size() < 4) {
      auto largest = open.end();
      for (auto i = open.begin(); i != open.end(); ++i) {
        if (At(*i).left < 0) continue;
        if (largest == open.end() || At(*i).box.Cells() > At(*largest).box.Cells()) largest = i;
      }
      if (largest == open.end()) break;
      const Branch& opened = At(*largest);
      *largest = opened.left;
      open.push_back(opened.right);
    }
    const int index = static_cast<int>(nodes->size());
    BoxNode node;
    for (size_t c = 0; c < 4; ++c) {
      const bool there = c < open.size();
      const CellBox box =
          there ? At(open[c]).box : CellBox{Vector3i::Constant(65535), Vector3i::Zero()};
      for (int a = 0; a < 3; ++a) {
        node.lower[a][c] = static_cast<uint16_t>(box.lower[a]);
        node.upper[a][c] = static_cast<uint16_t>(box.upper[a]);
      }
      node.child[c] = there ? BoxNode::kSolid : BoxNode::kAbsent;
    }
    nodes->push_back(node);
    for (size_t c = 0; c < open.size(); ++c) {
      if (At(open[c]).left < 0) continue;
      const int child = Emit(open[c], nodes);
      Nth(*nodes, index).child[c] = child;
    }
    return index;
  }

 private:
  const Branch& At(int i) const { return Nth(branches_, i); }

  // Calls visit(number) for each bit that is set.
  template <typename Visit>
  static void ForEachBit(const uint64_t* bits, int words, const Visit& visit) {
    for (int w = 0; w < words; ++w) {
      for (uint64_t rest = bits[w]; rest != 0; rest &= rest - 1) {
        visit(64 * w + std::countr_zero(rest));
      }
    }
  }

  Slices Slice(const CellBox& box) const {
    Slices slices;
    const Vector3i size = box.upper - box.lower;
    for (int a = 0; a < 3; ++a) {
      Nth(slices.of, a).assign(static_cast<size_t>(size[a]), kNothing);
    }
    const int words = grid_.words_per_column();
    // Union of the columns over y for each x, and over x for each y.
    std::vector<uint64_t> along_y(static_cast<size_t>(words)), seen_x(along_y), fresh(along_y);
    std::vector<uint64_t> along_x(static_cast<size_t>(words * size.y()), 0);
    std::vector<uint64_t> mask(static_cast<size_t>(words), 0);
    for (int k = box.lower.z(); k < box.upper.z(); ++k) {
      Nth(mask, k / 64) |= uint64_t{1} << (k % 64);
    }
    const auto grow = [](CellBox* slice, int x, int y, int z) {
      const Vector3i cell(x, y, z);
      slice->lower = slice->lower.cwiseMin(cell);
      slice->upper = slice->upper.cwiseMax(cell + Vector3i::Ones());
    };
    for (int x = box.lower.x(); x < box.upper.x(); ++x) {
      CellBox& slice_x = Nth(slices.of[0], x - box.lower.x());
      std::fill(along_y.begin(), along_y.end(), 0);
      for (int y = box.lower.y(); y < box.upper.y(); ++y) {
        CellBox& slice_y = Nth(slices.of[1], y - box.lower.y());
        const uint64_t* column = grid_.Column(x, y);
        int low = -1, high = -1;
        for (int w = 0; w < words; ++w) {
          const uint64_t bits = column[w] & Nth(mask, w);
          if (bits == 0) continue;
          slices.occupied += std::popcount(bits);
          Nth(along_y, w) |= bits;
          Nth(along_x, (y - box.lower.y()) * words + w) |= bits;
          if (low < 0) low = 64 * w + std::countr_zero(bits);
          high = 64 * w + 63 - std::countl_zero(bits);
        }
        if (low < 0) continue;
        for (CellBox* slice : {&slice_x, &slice_y}) {
          grow(slice, x, y, low);
          grow(slice, x, y, high);
        }
      }
      ForEachBit(along_y.data(), words, [&](int k) {
        CellBox& slice = Nth(slices.of[2], k - box.lower.z());
        slice.lower.x() = std::min(slice.lower.x(), x);
        slice.upper.x() = x + 1;
        slice.lower.z() = k;
        slice.upper.z() = k + 1;
      });
    }
    for (int y = box.lower.y(); y < box.upper.y(); ++y) {
      ForEachBit(&Nth(along_x, (y - box.lower.y()) * words), words, [&](int k) {
        CellBox& slice = Nth(slices.of[2], k - box.lower.z());
        slice.lower.y() = std::min(slice.lower.y(), y);
        slice.upper.y() = y + 1;
      });
    }
    return slices;
  }

  struct Cut {
    int axis = 0, at = 0;
  };
  static Cut Halves(const CellBox& box) {
    int axis = 0;
    (box.upper - box.lower).maxCoeff(&axis);
    return {axis, (box.lower[axis] + box.upper[axis]) / 2};
  }
  // The cut whose two sides' bounds hold the fewest cells; of equal ones the most even.
  static Cut BestCut(const Slices& slices, const CellBox& within, const CellBox& box) {
    Cut best;
    int64_t least = std::numeric_limits<int64_t>::max();
    int evenness = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto& of = Nth(slices.of, axis);
      std::vector<int64_t> above(of.size() + 1, 0);
      CellBox rest = kNothing;
      for (size_t i = of.size(); i-- > 0;) {
        rest = Join(rest, of[i]);
        above[i] = rest.lower.x() > rest.upper.x() ? 0 : rest.Cells();
      }
      CellBox below = kNothing;
      for (int at = within.lower[axis] + 1; at < within.upper[axis]; ++at) {
        const int i = at - within.lower[axis];
        below = Join(below, Nth(of, i - 1));
        if (at <= box.lower[axis] || at >= box.upper[axis]) continue;
        const int64_t cells = below.Cells() + Nth(above, i);
        const int even = std::min(at - box.lower[axis], box.upper[axis] - at);
        if (cells < least || (cells == least && even > evenness)) {
          least = cells;
          evenness = even;
          best = {axis, at};
        }
      }
    }
    return best;
  }

  const VoxelGrid& grid_;
  std::vector<Branch> branches_;
};

// The middle of one solid box of each part.
std::vector<Vector3d> FindParts(const BoxTree& tree, const Vector3i& size) {
  const std::vector<CellBox> boxes = tree.SolidBoxes();
  const auto index = [&](int x, int y, int z) {
    return static_cast<size_t>((int64_t{x} * size.y() + y) * size.z() + z);
  };
  std::vector<int> owner(index(size.x(), 0, 0), -1), parent(boxes.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int i) {
    while (Nth(parent, i) != i) {
      int& up = Nth(parent, i);
      i = up = Nth(parent, up);
    }
    return i;
  };
  for (size_t b = 0; b < boxes.size(); ++b) {
    const auto& [lower, upper] = boxes[b];
    for (int x = lower.x(); x < upper.x(); ++x) {
      for (int y = lower.y(); y < upper.y(); ++y) {
        const auto column = owner.begin() + static_cast<std::ptrdiff_t>(index(x, y, 0));
        std::fill(column + lower.z(), column + upper.z(), static_cast<int>(b));
      }
    }
  }
  const auto join = [&](size_t cell, size_t next) {
    if (owner[cell] < 0 || owner[next] < 0 || owner[cell] == owner[next]) return;
    Nth(parent, root(owner[cell])) = root(owner[next]);
  };
  for (int x = 0; x < size.x(); ++x) {
    for (int y = 0; y < size.y(); ++y) {
      for (int z = 0; z < size.z(); ++z) {
        const size_t cell = index(x, y, z);
        if (x + 1 < size.x()) join(cell, index(x + 1, y, z));
        if (y + 1 < size.y()) join(cell, index(x, y + 1, z));
        if (z + 1 < size.z()) join(cell, cell + 1);
      }
    }
  }
  std::vector<Vector3d> parts;
  for (size_t b = 0; b < boxes.size(); ++b) {
    if (root(static_cast<int>(b)) != static_cast<int>(b)) continue;
    parts.push_back(0.5 * (tree.Corner(boxes[b].lower) + tree.Corner(boxes[b].upper)));
  }
  return parts;
}

}  // namespace

BoxTree BoxTree::Build(const VoxelGrid& grid) {
  BoxTree tree;
  tree.origin = grid.origin();
  tree.cell = grid.cell();
  Builder builder(grid);
  const int root = builder.Split({Vector3i::Zero(), grid.size()}, 0);
  if (root >= 0) builder.Emit(root, &tree.nodes);
  tree.parts = FindParts(tree, grid.size());
  return tree;
}

}  // namespace halfstep
