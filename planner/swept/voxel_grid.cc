#include "planner/swept/voxel_grid.h"

#include <algorithm>
#include <cmath>

#include "planner/swept/ceiling.h"
#include "planner/swept/four_floats.h"
#include "wpg/check.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// By which regions count as larger, of their size and height: half-spaces are cut in float, where a
// metre over kSteep is off by 1e-5 m.
constexpr double kRounding = 4e-5;
// Least |n_z| of a half-space that cuts z as it is. Of a steeper one only its least bound over the
// region's height is kept.
constexpr double kSteep = 0.01;
constexpr int kRows = 4;  // that planes are left out of at once

// Where columns begin, and how high a region is.
struct Columns {
  Eigen::Vector3d corner;  // of the first one [m]
  double cell, rounding, lower_z, upper_z;
};

// The region's half-spaces, as what bounds z from above and from below in each column.
void AddPlanes(const HalfSpaces& region, const Columns& columns, Ceiling* above, Ceiling* below) {
  for (Eigen::Index p = 0; p < region.normals.cols(); ++p) {
    const Eigen::Vector3d& n = region.normals.col(p);
    // What the half-space leaves for n_z·z in the first column, at the best corner of its
    // rectangle.
    double room = region.offsets[p] -
                  n.x() * (columns.corner.x() + (n.x() > 0 ? 0 : columns.cell)) -
                  n.y() * (columns.corner.y() + (n.y() > 0 ? 0 : columns.cell));
    double slope = n.z();
    if (std::abs(n.z()) < kSteep) {
      // room − min n_z·z ≥ 0 in each column that is met; so upper_z and more of it bounds z.
      slope = kSteep;
      room += slope * columns.upper_z - std::min(n.z() * columns.lower_z, n.z() * columns.upper_z);
    }
    const double at = room / slope + (slope > 0 ? columns.rounding : -columns.rounding);
    const double per_x = -n.x() * columns.cell / slope, per_y = -n.y() * columns.cell / slope;
    if (slope > 0) {
      above->Add(at, per_x, per_y);
    } else {
      below->Add(-at, -per_x, -per_y);
    }
  }
}

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
  // Both count upwards: of what is below, the negatives.
  const auto planes = static_cast<size_t>(region.normals.cols());
  Ceiling above(static_cast<float>(upper.z()), planes);
  Ceiling below(-static_cast<float>(lower.z()), planes);
  AddPlanes(region, {corner, cell_, rounding, lower.z(), upper.z()}, &above, &below);
  const int columns = last.x() - first.x() + 1, rows = last.y() - first.y() + 1;
  const auto blocks = static_cast<size_t>((columns + 7) / 8);
  std::vector<float> from(8 * blocks), to(8 * blocks);
  const double highest = size_.z() - 1;
  for (int j = 0; j < rows; ++j) {
    const float row = static_cast<float>(j);
    if (j % kRows == 0) {
      above.EnterRows(row, row + (kRows - 1), static_cast<float>(columns - 1));
      below.EnterRows(row, row + (kRows - 1), static_cast<float>(columns - 1));
    }
    above.Row(row, blocks, to.data());
    below.Row(row, blocks, from.data());
    for (int i = 0; i < columns; i += 4) {
      const Eigen::Array4f up = Eigen::Map<const Eigen::Array4f>(&Nth(to, i));
      const Eigen::Array4f down = -Eigen::Map<const Eigen::Array4f>(&Nth(from, i));
      const Eigen::Array4d low = (down.cast<double>() - rounding - origin_.z()) / cell_;
      const Eigen::Array4d high = (up.cast<double>() + rounding - origin_.z()) / cell_;
      const Eigen::Array4i begin = low.max(0.0).min(highest).cast<int>();
      const Eigen::Array4i end = high.max(0.0).min(highest).cast<int>();
      for (int c = 0; c < std::min(4, columns - i); ++c) {
        if (!(down[c] <= up[c]) || !(high[c] >= 0)) continue;
        OccupyRange(first.x() + i + c, first.y() + j, begin[c], end[c]);
      }
    }
  }
}

}  // namespace halfstep
