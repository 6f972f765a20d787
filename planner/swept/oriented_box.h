#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "planner/swept/box_tree.h"
#include "planner/swept/four_floats.h"

namespace halfstep {

/// A solid box: `axes` are unit and orthogonal columns, left-handed after a reflection.
struct OrientedBox {
  Eigen::Vector3d center{0, 0, 0};                     ///< [m]
  Eigen::Vector3d half{0, 0, 0};                       ///< half edge lengths [m] ≥ 0
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns: the box's axes, orthonormal
};

/// Oriented boxes against BoxNodes, four boxes at once, by separating axes. Lengths here are half
/// cells of a tree's lattice, so that the centres lower + upper and half sizes upper − lower of its
/// boxes are exact in float; what is rounded is the oriented box, and `slack` covers it.
class LatticeBoxTest {
 public:
  /// Boxes with these axes, of a tree's lattice. `extra`: the tree's boxes count as larger by this
  /// on every side [m].
  LatticeBoxTest(const BoxTree& tree, const Eigen::Matrix3d& axes, double extra)
      : origin_(tree.origin), scale_(2.0 / tree.cell), extra_(static_cast<float>(scale_ * extra)) {
    upright_ = std::abs(axes(2, 0)) + std::abs(axes(2, 1)) < 1e-9 &&
               std::abs(axes(0, 2)) + std::abs(axes(1, 2)) < 1e-9;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        R_[i][j] = static_cast<float>(axes(i, j));
        // Above zero: the cross product of nearly parallel axes must not separate by rounding.
        A_[i][j] = std::abs(R_[i][j]) + 1e-6f;
      }
    }
  }

  /// Where the next boxes along the axes lie: centre and half edge lengths [m].
  void Place(const Eigen::Vector3d& center, const Eigen::Vector3d& half) {
    float sum = 0.0f, far = 0.0f;
    for (int i = 0; i < 3; ++i) {
      T_[i] = static_cast<float>(scale_ * (center[i] - origin_[i]));
      a_[i] = static_cast<float>(scale_ * half[i]);
      sum += a_[i];
      far = std::max(far, std::abs(T_[i]));
    }
    const float slack = 2e-6f * (far + sum + 512.0f + extra_);
    for (int i = 0; i < 3; ++i) {
      reach_[i] = A_[i][0] * a_[0] + A_[i][1] * a_[1] + A_[i][2] * a_[2] + slack;
      from_center_[i] = a_[i] + 2.0f * slack;
    }
    slack_ = slack;
  }

  /// Bit c: the box may meet child c of the node. Exact up to the slack for boxes that do not
  /// nearly touch.
  int Hits(const BoxNode& node) const { return upright_ ? Hits<true>(node) : Hits<false>(node); }

 private:
  template <bool kUpright>
  int Hits(const BoxNode& node) const {
    const Four x0 = Four::Load(node.lower[0]), x1 = Four::Load(node.upper[0]);
    const Four y0 = Four::Load(node.lower[1]), y1 = Four::Load(node.upper[1]);
    const Four z0 = Four::Load(node.lower[2]), z1 = Four::Load(node.upper[2]);
    const Four dx = Four(T_[0]) - (x0 + x1), dy = Four(T_[1]) - (y0 + y1);
    const Four dz = Four(T_[2]) - (z0 + z1);
    const Four extra(extra_);
    const Four ex = x1 - x0 + extra, ey = y1 - y0 + extra, ez = z1 - z0 + extra;
    int mask = dx.Abs().Within(ex + Four(reach_[0])) & dy.Abs().Within(ey + Four(reach_[1])) &
               dz.Abs().Within(ez + Four(reach_[2]));
    if (mask == 0) return 0;
    for (int j = 0; j < (kUpright ? 2 : 3); ++j) {
      Four along = dx * Four(R_[0][j]) + dy * Four(R_[1][j]);
      Four most = ex * Four(A_[0][j]) + ey * Four(A_[1][j]) + Four(from_center_[j]);
      if constexpr (!kUpright) {
        along = along + dz * Four(R_[2][j]);
        most = most + ez * Four(A_[2][j]);
      }
      mask &= along.Abs().Within(most);
    }
    if (kUpright || mask == 0) return mask;
    return mask & CrossHits({dx, dy, dz}, {ex, ey, ez});
  }

  // Axes across an edge of the tree's boxes and one of the oriented box.
  int CrossHits(const std::array<Four, 3>& d, const std::array<Four, 3>& e) const {
    int mask = 15;
    for (size_t i = 0; i < 3 && mask != 0; ++i) {
      const size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3;
      for (size_t j = 0; j < 3; ++j) {
        const size_t j1 = (j + 1) % 3, j2 = (j + 2) % 3;
        const Four along = d[i2] * Four(R_[i1][j]) - d[i1] * Four(R_[i2][j]);
        const Four most = e[i1] * Four(A_[i2][j]) + e[i2] * Four(A_[i1][j]) +
                          Four(a_[j1] * A_[i][j2] + a_[j2] * A_[i][j1] + 2.0f * slack_);
        mask &= along.Abs().Within(most);
      }
    }
    return mask;
  }

  Eigen::Vector3d origin_;
  double scale_;
  float extra_;
  bool upright_;
  float R_[3][3], A_[3][3];
  float T_[3] = {}, a_[3] = {}, reach_[3] = {}, from_center_[3] = {};
  float slack_ = 0.0f;
};

}  // namespace halfstep
