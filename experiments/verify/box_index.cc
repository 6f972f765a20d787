#include "experiments/verify/box_index.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace halfstep::verify {

BoxIndex::BoxIndex(std::vector<Eigen::AlignedBox3d> boxes) : boxes_(std::move(boxes)) {
  if (boxes_.empty()) return;
  order_.resize(boxes_.size());
  std::iota(order_.begin(), order_.end(), size_t{0});
  nodes_.push_back({.first = 0, .last = order_.size()});
  for (size_t n = 0; n < nodes_.size(); ++n) {
    Node node = nodes_[n];
    for (size_t i = node.first; i < node.last; ++i) node.bounds.extend(boxes_[order_[i]]);
    if (node.last - node.first > kLeaf) {
      Eigen::Index axis = 0;
      node.bounds.sizes().maxCoeff(&axis);
      const size_t middle = node.first + (node.last - node.first) / 2;
      const auto at = [this](size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
      std::nth_element(at(node.first), at(middle), at(node.last), [&](size_t a, size_t b) {
        return boxes_[a].min()[axis] + boxes_[a].max()[axis] <
               boxes_[b].min()[axis] + boxes_[b].max()[axis];
      });
      node.right = nodes_.size() + 1;
      nodes_.push_back({.first = node.first, .last = middle});
      nodes_.push_back({.first = middle, .last = node.last});
    }
    nodes_[n] = node;
  }
}

std::vector<size_t> BoxIndex::Meeting(const Eigen::AlignedBox3d& box) const {
  std::vector<size_t> found;
  const auto key = [&box](const Eigen::AlignedBox3d& bounds) {
    return bounds.intersects(box) ? 0.0 : std::numeric_limits<double>::infinity();
  };
  Walk(key, [&](size_t i) {
    if (boxes_[i].intersects(box)) found.push_back(i);
  });
  return found;
}

}  // namespace halfstep::verify
