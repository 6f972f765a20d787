#include "wpg/geometry/bounds_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "wpg/check.h"
#include "wpg/nth.h"

namespace halfstep {

BoundsTree::BoundsTree(const std::vector<Eigen::AlignedBox3d>& boxes, int32_t leaf) {
  HALFSTEP_CHECK(leaf >= 1, "leaf = " << leaf);
  if (boxes.empty()) return;
  std::vector<Eigen::Vector3d> middles;
  middles.reserve(boxes.size());
  for (const Eigen::AlignedBox3d& box : boxes) {
    HALFSTEP_CHECK(!box.isEmpty() && box.min().allFinite() && box.max().allFinite(),
                   "box " << middles.size());
    middles.push_back(box.center());
  }
  order.resize(boxes.size());
  std::iota(order.begin(), order.end(), 0);
  struct Task {
    int32_t node, first, count;
  };
  nodes.emplace_back();
  std::vector<Task> tasks = {{0, 0, static_cast<int32_t>(boxes.size())}};
  std::vector<std::pair<double, int32_t>> keys;  // along an axis, and the item
  while (!tasks.empty()) {
    const Task task = tasks.back();
    tasks.pop_back();
    const auto begin = order.begin() + task.first, end = begin + task.count;
    const auto left = static_cast<int32_t>(nodes.size());
    Node& node = Nth(nodes, task.node);
    node.first = task.first;
    node.count = task.count;
    if (task.count > leaf) {
      node.left = left;
      Eigen::AlignedBox3d of_middles;
      for (auto i = begin; i != end; ++i) of_middles.extend(Nth(middles, *i));
      int axis = 0;
      of_middles.sizes().maxCoeff(&axis);
      const int32_t below = task.count / 2;
      keys.clear();
      for (auto i = begin; i != end; ++i) keys.emplace_back(Nth(middles, *i)[axis], *i);
      std::nth_element(keys.begin(), keys.begin() + below, keys.end());
      std::ranges::transform(keys, begin, &std::pair<double, int32_t>::second);
      nodes.emplace_back();
      nodes.emplace_back();
      tasks.push_back({left, task.first, below});
      tasks.push_back({left + 1, task.first + below, task.count - below});
    }
  }
  // Children before their parents.
  std::vector<Eigen::AlignedBox3d> around(nodes.size());
  for (size_t n = nodes.size(); n-- > 0;) {
    Node& node = nodes[n];
    if (node.left >= 0) {
      around[n] = Nth(around, node.left).merged(Nth(around, node.left + 1));
    } else {
      for (int32_t i = node.first; i < node.first + node.count; ++i) {
        around[n].extend(Nth(boxes, Nth(order, i)));
      }
    }
    node.center = around[n].center();
    // From the rounded centre, so that the box holds both ends.
    node.half =
        (around[n].max() - node.center).cwiseMax(node.center - around[n].min()) * (1 + 1e-12);
  }
}

}  // namespace halfstep
