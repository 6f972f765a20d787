#include "planner/swept/voxel_grid.h"

#include <algorithm>
#include <cmath>

#include "planner/swept/four_floats.h"
#include "wpg/check.h"

namespace halfstep {
namespace {

// By which regions count as larger, of their size and height: half-spaces are cut in float, where a
// metre over kSteep is off by 1e-5 m.
constexpr double kRounding = 4e-5;
// Least |n_z| of a half-space that cuts z as it is. Of a steeper one only its least bound over the
// region's height is kept.
constexpr double kSteep = 0.01;

// Above or below a column: z ≤ (or ≥) at + per_x·i + per_y·j, i and j counted in cells.
struct Cut {
  float at, per_x, per_y;
};

}  // namespace

VoxelGrid::VoxelGrid(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper, double cell)
    : cell_(cell) {
  HALFSTEP_CHECK(cell > 0.0 && lower.allFinite() && upper.allFinite(), "cell = " << cell);
  const Eigen::Array3d first = (lower.array() / cell).floor() - 1.0;
  const Eigen::Array3d count = (upper.array() / cell).ceil() + 1.0 - first;
  HALFSTEP_CHECK((count > 0.0).all() && (count < 65000.0).all() && count.prod() < 4294967296.0,
                 "cells: " << count.transpose());
  origin_ = cell * first.matrix();
  size_ = count.cast<int>().matrix();
  words_per_column_ = (size_.z() + 63) / 64;
  words_.assign(Word(size_.x(), 0), 0);
}

void VoxelGrid::OccupyRange(int i, int j, int from, int to) {
  uint64_t* column = &words_[Word(i, j)];
  for (int w = from / 64; w <= to / 64; ++w) {
    const int low = std::max(from - 64 * w, 0), high = std::min(to - 64 * w, 63);
    column[w] |= (~uint64_t{0} >> (63 - (high - low))) << low;
  }
}

void VoxelGrid::Fill(const HalfSpaces& region) {
  const double size = (region.upper - region.lower).maxCoeff() +
                      std::max(std::abs(region.lower.z()), std::abs(region.upper.z()));
  const double rounding = kRounding * std::max(1.0, size);  // [m]
  const Eigen::Vector3d slack = Eigen::Vector3d::Constant(rounding);
  const Eigen::Vector3d lower = region.lower - slack, upper = region.upper + slack;
  const auto index = [&](const Eigen::Vector3d& p) -> Eigen::Vector3i {
    return ((p - origin_) / cell_).array().floor().matrix().cast<int>();
  };
  const Eigen::Vector3i first = index(lower), last = index(upper);
  HALFSTEP_CHECK((first.array() >= 0).all() && (last.array() < size_.array()).all(),
                 "the region leaves the grid: " << first.transpose() << " … " << last.transpose());
  const Eigen::Vector3d corner = origin_ + cell_ * first.cast<double>();
  std::vector<Cut> above, below;
  for (Eigen::Index p = 0; p < region.normals.cols(); ++p) {
    const Eigen::Vector3d& n = region.normals.col(p);
    // What the half-space leaves for n_z·z in the first column, at the best corner of its
    // rectangle.
    double room = region.offsets[p] - n.x() * (corner.x() + (n.x() > 0 ? 0 : cell_)) -
                  n.y() * (corner.y() + (n.y() > 0 ? 0 : cell_));
    double slope = n.z();
    if (std::abs(n.z()) < kSteep) {
      // room − min n_z·z ≥ 0 in each column that is met; so upper.z and more of it bounds z.
      slope = kSteep;
      room += slope * upper.z() - std::min(n.z() * lower.z(), n.z() * upper.z());
    }
    const double at = room / slope + (slope > 0 ? rounding : -rounding);
    (slope > 0 ? above : below)
        .push_back({static_cast<float>(at), static_cast<float>(-n.x() * cell_ / slope),
                    static_cast<float>(-n.y() * cell_ / slope)});
  }
  const Four top(static_cast<float>(upper.z())), bottom(static_cast<float>(lower.z()));
  const float offsets[4] = {0, 1, 2, 3};
  for (int j = 0; first.y() + j <= last.y(); ++j) {
    for (int i = 0; first.x() + i <= last.x(); i += 4) {
      const Four columns = Four(static_cast<float>(i)) + Four::Load(offsets);
      const float row = static_cast<float>(j);
      Four high = top, low = bottom;
      for (const Cut& cut : above) {
        high = Min(high, Four(cut.at + row * cut.per_y) + Four(cut.per_x) * columns);
      }
      for (const Cut& cut : below) {
        low = Max(low, Four(cut.at + row * cut.per_y) + Four(cut.per_x) * columns);
      }
      float from[4], to[4];
      low.Store(from);
      high.Store(to);
      for (int c = 0; c < 4 && first.x() + i + c <= last.x(); ++c) {
        if (!(from[c] <= to[c])) continue;
        const double k0 = std::floor((from[c] - rounding - origin_.z()) / cell_);
        const double k1 = std::floor((to[c] + rounding - origin_.z()) / cell_);
        OccupyRange(first.x() + i + c, first.y() + j, std::max(static_cast<int>(k0), 0),
                    std::min(static_cast<int>(k1), size_.z() - 1));
      }
    }
  }
}

}  // namespace halfstep
