#include "planner/voxel_grid.h"

#include <algorithm>
#include <cmath>

#include "wpg/check.h"

namespace halfstep {
namespace {

constexpr double kRounding = 1e-9;  // [m] by which cells and regions count as larger
constexpr double kUpright = 1e-6;   // |n_z| below which a half-space bounds columns, not z

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
  const Eigen::Vector3d slack = Eigen::Vector3d::Constant(kRounding);
  const auto index = [&](const Eigen::Vector3d& p) -> Eigen::Vector3i {
    return ((p - origin_) / cell_).array().floor().matrix().cast<int>();
  };
  const Eigen::Vector3i first = index(region.lower - slack), last = index(region.upper + slack);
  HALFSTEP_CHECK((first.array() >= 0).all() && (last.array() < size_.array()).all(),
                 "the region leaves the grid: " << first.transpose() << " … " << last.transpose());
  const Eigen::Index columns = last.x() - first.x() + 1;
  const Eigen::ArrayXd steps =
      Eigen::ArrayXd::LinSpaced(columns, 0.0, static_cast<double>(columns - 1));
  const double x0 = origin_.x() + first.x() * cell_;
  Eigen::ArrayXd low(columns), high(columns);
  const Eigen::Index planes = region.normals.cols();
  for (int j = first.y(); j <= last.y(); ++j) {
    const double y0 = origin_.y() + j * cell_;
    low.setConstant(region.lower.z() - kRounding);
    high.setConstant(region.upper.z() + kRounding);
    for (Eigen::Index p = 0; p < planes; ++p) {
      const Eigen::Vector3d& n = region.normals.col(p);
      // What is left for n_z·z in the column that begins at x0, at the best corner of its
      // rectangle.
      const double room = region.offsets[p] + kRounding - n.x() * (n.x() > 0 ? x0 : x0 + cell_) -
                          n.y() * (n.y() > 0 ? y0 : y0 + cell_);
      const double slope = -n.x() * cell_;
      if (n.z() > kUpright) {
        high = high.min(room / n.z() + slope / n.z() * steps);
      } else if (n.z() < -kUpright) {
        low = low.max(room / n.z() + slope / n.z() * steps);
      } else {
        const double most = room - std::min(n.z() * region.lower.z(), n.z() * region.upper.z());
        high = (most + slope * steps < 0.0).select(-std::numeric_limits<double>::infinity(), high);
      }
    }
    for (Eigen::Index c = 0; c < columns; ++c) {
      if (!(low[c] <= high[c])) continue;
      const double from = std::floor((low[c] - kRounding - origin_.z()) / cell_);
      const double to = std::floor((high[c] + kRounding - origin_.z()) / cell_);
      OccupyRange(first.x() + static_cast<int>(c), j, std::max(static_cast<int>(from), 0),
                  std::min(static_cast<int>(to), size_.z() - 1));
    }
  }
}

}  // namespace halfstep
