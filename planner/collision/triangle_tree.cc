#include "planner/collision/triangle_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "wpg/check.h"

namespace halfstep {
namespace {

constexpr int kLeaf = 4;  // triangles

}  // namespace

TriangleTree::TriangleTree(const TriangleMesh& mesh) {
  const Eigen::Index count = mesh.triangles.cols();
  HALFSTEP_CHECK(count > 0 && mesh.vertices.allFinite(), count << " triangles");
  std::vector<Eigen::Matrix3d> all;
  std::vector<Eigen::Vector3d> middles;
  for (const Eigen::Vector3i& t : mesh.triangles.colwise()) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = mesh.vertices.col(t[k]);
    middles.push_back(corners.rowwise().mean());
    all.push_back(corners);
  }
  std::vector<int32_t> order(all.size());
  std::iota(order.begin(), order.end(), 0);
  struct Task {
    int32_t node, first, count;
  };
  nodes.emplace_back();
  std::vector<Task> tasks = {{0, 0, static_cast<int32_t>(count)}};
  while (!tasks.empty()) {
    const Task task = tasks.back();
    tasks.pop_back();
    const auto begin = order.begin() + task.first, end = begin + task.count;
    Eigen::Vector3d lower = Eigen::Vector3d::Constant(1e300), upper = -lower;
    Eigen::Vector3d least = lower, most = upper;
    for (auto i = begin; i != end; ++i) {
      const Eigen::Matrix3d& corners = all[static_cast<size_t>(*i)];
      lower = lower.cwiseMin(corners.rowwise().minCoeff());
      upper = upper.cwiseMax(corners.rowwise().maxCoeff());
      least = least.cwiseMin(middles[static_cast<size_t>(*i)]);
      most = most.cwiseMax(middles[static_cast<size_t>(*i)]);
    }
    Node node{
        .center = 0.5 * (lower + upper), .half = {}, .first = task.first, .count = task.count};
    // From the rounded centre, so that the box holds both ends.
    node.half = (upper - node.center).cwiseMax(node.center - lower) * (1 + 1e-12);
    if (task.count > kLeaf) {
      int axis = 0;
      (most - least).maxCoeff(&axis);
      const int32_t below = task.count / 2;
      std::nth_element(begin, begin + below, end, [&](int32_t a, int32_t b) {
        const double at_a = middles[static_cast<size_t>(a)][axis];
        const double at_b = middles[static_cast<size_t>(b)][axis];
        return at_a < at_b || (at_a == at_b && a < b);
      });
      node.left = static_cast<int32_t>(nodes.size());
      nodes.emplace_back();
      nodes.emplace_back();
      tasks.push_back({node.left, task.first, below});
      tasks.push_back({node.left + 1, task.first + below, task.count - below});
    }
    nodes[static_cast<size_t>(task.node)] = node;
  }
  for (int32_t i : order) triangles.push_back(all[static_cast<size_t>(i)]);
}

bool TriangleMeetsBox(const Eigen::Matrix3d& corners, const Eigen::Vector3d& half) {
  const double slack = 1e-12 * (corners.cwiseAbs().maxCoeff() + half.maxCoeff());
  const Eigen::Vector3d size = half.array() + slack;
  if ((corners.rowwise().minCoeff().array() > size.array()).any() ||
      (corners.rowwise().maxCoeff().array() < -size.array()).any()) {
    return false;
  }
  const auto apart_along = [&](const Eigen::Vector3d& axis) {
    const Eigen::RowVector3d at = axis.transpose() * corners;
    const double reach = axis.cwiseAbs().dot(size) + slack * axis.lpNorm<1>();
    return at.minCoeff() > reach || at.maxCoeff() < -reach;
  };
  const Eigen::Vector3d e0 = corners.col(1) - corners.col(0), e1 = corners.col(2) - corners.col(1);
  if (apart_along(e0.cross(e1))) return false;
  const Eigen::Vector3d e2 = corners.col(0) - corners.col(2);
  for (const Eigen::Vector3d& e : {e0, e1, e2}) {
    if (apart_along({0, -e.z(), e.y()}) || apart_along({e.z(), 0, -e.x()}) ||
        apart_along({-e.y(), e.x(), 0})) {
      return false;
    }
  }
  return true;
}

}  // namespace halfstep
