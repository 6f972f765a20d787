#include "planner/scene/voxel_set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

namespace halfstep {
namespace {

constexpr int kBits = 21;
constexpr int kShift = 1 << (kBits - 1);
constexpr std::uint64_t kMask = (std::uint64_t{1} << kBits) - 1;

}  // namespace

std::uint64_t VoxelSet::KeyOf(const Eigen::Vector3i& cell) {
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    key = key << kBits | static_cast<std::uint64_t>(cell[axis] + kShift);
  }
  return key;
}

Eigen::Vector3i VoxelSet::CellOf(std::uint64_t key) {
  Eigen::Vector3i cell;
  for (int axis = 2; axis >= 0; --axis, key >>= kBits) {
    cell[axis] = static_cast<int>(key & kMask) - kShift;
  }
  return cell;
}

void VoxelSet::Add(const Eigen::Vector3i& cell) {
  keys_.push_back(KeyOf(cell));
  // Most cells come again and again: what is there twice goes before the memory does.
  if (keys_.size() >= std::max<size_t>(2 * sorted_, 1 << 20)) Finish();
}

bool VoxelSet::AddBall(const Eigen::Vector3d& center, double radius) {
  const double rounding = 1e-9 * (cell_ + radius + center.cwiseAbs().maxCoeff());
  const double reach = radius + rounding;
  const Eigen::Vector3d lower = ((center.array() - reach) / cell_).floor();
  const Eigen::Vector3d upper = ((center.array() + reach) / cell_).floor();
  if (!(lower.minCoeff() >= -kFarthest && upper.maxCoeff() <= kFarthest)) return false;
  const Eigen::Vector3i from = lower.cast<int>(), to = upper.cast<int>();
  for (int i = from.x(); i <= to.x(); ++i) {
    for (int j = from.y(); j <= to.y(); ++j) {
      for (int k = from.z(); k <= to.z(); ++k) {
        const Eigen::Vector3d corner = cell_ * Eigen::Vector3d(i, j, k);
        const Eigen::Vector3d nearest =
            center.cwiseMax(corner).cwiseMin(Eigen::Vector3d(corner.array() + cell_));
        if ((nearest - center).norm() <= reach) Add({i, j, k});
      }
    }
  }
  return true;
}

void VoxelSet::Finish() {
  std::sort(keys_.begin(), keys_.end());
  keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
  sorted_ = keys_.size();
}

bool VoxelSet::Has(const Eigen::Vector3i& cell) const {
  return std::binary_search(keys_.begin(), keys_.end(), KeyOf(cell));
}

bool VoxelSet::Contains(const Eigen::Vector3d& point) const {
  const Eigen::Array3d cell = (point.array() / cell_).floor();
  return (cell.abs() <= kFarthest).all() && Has(cell.cast<int>().matrix());
}

TriangleMesh VoxelSet::Surface() const {
  std::unordered_map<std::uint64_t, int> numbers;  // of corners
  std::vector<Eigen::Vector3i> corners;
  std::vector<Eigen::Vector3i> triangles;
  const auto number = [&](const Eigen::Vector3i& corner) {
    const auto [at, fresh] = numbers.try_emplace(KeyOf(corner), static_cast<int>(corners.size()));
    if (fresh) corners.push_back(corner);
    return at->second;
  };
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3i ahead = Eigen::Vector3i::Unit(axis);
    const Eigen::Vector3i u = Eigen::Vector3i::Unit((axis + 1) % 3);
    const Eigen::Vector3i v = Eigen::Vector3i::Unit((axis + 2) % 3);
    for (const int sign : {-1, 1}) {
      const Eigen::Vector3i to_side = sign > 0 ? ahead : Eigen::Vector3i(0, 0, 0);
      // Neighbours come in the order of the cells, so one look through the keys finds all.
      auto neighbour = keys_.begin();
      for (const std::uint64_t key : keys_) {
        const Eigen::Vector3i cell = CellOf(key);
        const std::uint64_t wanted = KeyOf(cell + sign * ahead);
        while (neighbour != keys_.end() && *neighbour < wanted) ++neighbour;
        if (neighbour != keys_.end() && *neighbour == wanted) continue;
        const int a = number(cell + to_side), b = number(cell + to_side + u);
        const int c = number(cell + to_side + u + v), d = number(cell + to_side + v);
        if (sign > 0) {
          triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
        } else {
          triangles.insert(triangles.end(), {{a, c, b}, {a, d, c}});
        }
      }
    }
  }
  TriangleMesh mesh;
  mesh.vertices.resize(3, static_cast<Eigen::Index>(corners.size()));
  for (size_t i = 0; i < corners.size(); ++i) {
    mesh.vertices.col(static_cast<Eigen::Index>(i)) = cell_ * corners[i].cast<double>();
  }
  mesh.triangles.resize(3, static_cast<Eigen::Index>(triangles.size()));
  for (size_t i = 0; i < triangles.size(); ++i) {
    mesh.triangles.col(static_cast<Eigen::Index>(i)) = triangles[i];
  }
  return mesh;
}

}  // namespace halfstep
