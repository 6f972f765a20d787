#include "wpg/geometry/bounds_tree.h"

#include <algorithm>
#include <numeric>

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
  while (!tasks.empty()) {
    const Task task = tasks.back();
    tasks.pop_back();
    const auto begin = order.begin() + task.first, end = begin + task.count;
    Eigen::AlignedBox3d around, of_middles;
    for (auto i = begin; i != end; ++i) {
      around.extend(Nth(boxes, *i));
      of_middles.extend(Nth(middles, *i));
    }
    Node node{.center = around.center(), .half = {}, .first = task.first, .count = task.count};
    // From the rounded centre, so that the box holds both ends.
    node.half = (around.max() - node.center).cwiseMax(node.center - around.min()) * (1 + 1e-12);
    if (task.count > leaf) {
      int axis = 0;
      of_middles.sizes().maxCoeff(&axis);
      const int32_t below = task.count / 2;
      std::nth_element(begin, begin + below, end, [&](int32_t a, int32_t b) {
        const double at_a = Nth(middles, a)[axis];
        const double at_b = Nth(middles, b)[axis];
        return at_a < at_b || (at_a == at_b && a < b);
      });
      node.left = static_cast<int32_t>(nodes.size());
      nodes.emplace_back();
      nodes.emplace_back();
      tasks.push_back({node.left, task.first, below});
      tasks.push_back({node.left + 1, task.first + below, task.count - below});
    }
    Nth(nodes, task.node) = node;
  }
}

}  // namespace halfstep
