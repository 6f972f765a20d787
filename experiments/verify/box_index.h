#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <limits>
#include <vector>

namespace halfstep::verify {

/// Boxes in a tree of boxes, so that those near a place are found without a look at each. Verify's
/// own: the program's trees are not used.
class BoxIndex {
 public:
  BoxIndex() = default;
  /// Indices are places in `boxes`.
  explicit BoxIndex(std::vector<Eigen::AlignedBox3d> boxes);

  /// The indices of all boxes that share a point with a box, and of no others, in no order.
  std::vector<size_t> Meeting(const Eigen::AlignedBox3d& box) const;

  /// Calls visit(i) for the boxes i in leaves whose bounds have a finite key(bounds), and all
  /// bounds around them; sides with a smaller key first. The key may grow while boxes are visited.
  template <typename Key, typename Visit>
  void Walk(const Key& key, const Visit& visit) const {
    std::vector<size_t> open;
    if (!nodes_.empty()) open.push_back(0);
    while (!open.empty()) {
      const Node& node = nodes_[open.back()];
      open.pop_back();
      if (!(key(node.bounds) < std::numeric_limits<double>::infinity())) continue;
      if (node.last - node.first > kLeaf) {
        const bool left_first =
            key(nodes_[node.right - 1].bounds) <= key(nodes_[node.right].bounds);
        open.push_back(left_first ? node.right : node.right - 1);
        open.push_back(left_first ? node.right - 1 : node.right);
        continue;
      }
      for (size_t i = node.first; i < node.last; ++i) visit(order_[i]);
    }
  }

 private:
  static constexpr size_t kLeaf = 4;
  struct Node {
    Eigen::AlignedBox3d bounds{};
    size_t first = 0, last = 0;  // its boxes, in order_
    size_t right = 0;            // more than kLeaf boxes: the children are right − 1 and right
  };
  std::vector<Eigen::AlignedBox3d> boxes_;
  std::vector<size_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace halfstep::verify
