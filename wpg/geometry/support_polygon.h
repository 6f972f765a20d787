#pragma once

#include <Eigen/Core>
#include <array>

#include "wpg/geometry/pose2.h"
#include "wpg/geometry/side.h"

namespace halfstep {

/// Convex support polygon of one or two soles (at most 8 corners), counter-clockwise.
class SupportPolygon {
 public:
  /// One sole: a rectangle of full length and width `sole_size` [m], centred at X_WS.
  SupportPolygon(const Pose2& X_WS, const Eigen::Vector2d& sole_size);
  /// Two soles: their convex hull.
  SupportPolygon(const Pose2& X_WL, const Pose2& X_WR, const Eigen::Vector2d& sole_size);
  /// All (1 − share)·l + share·r with l in the left and r in the right sole, share ∈ [0, 1]: 8
  /// corners, some of them equal where share is 0 or 1.
  static SupportPolygon Section(const Pose2& X_WL, const Pose2& X_WR,
                                const Eigen::Vector2d& sole_size, double share);

  int size() const { return size_; }  ///< number of corners, 4 to 8
  /// Corner i, counter-clockwise, in W [m].
  Eigen::Vector2d corner(int i) const { return corners_.col(i); }

  /// Least distance inside the edges' lines [m]: positive inside, where it is the distance to the
  /// boundary; negative outside, where it is no more than minus the distance to the nearest edge
  /// line.
  double Margin(const Eigen::Vector2d& p_W) const;

 private:
  SupportPolygon() = default;

  Eigen::Matrix<double, 2, 8> corners_;
  int size_ = 0;
};

/// Corners of a sole rectangle (2×4), counter-clockwise [m].
Eigen::Matrix<double, 2, 4> SoleCorners(const Pose2& X_WS, const Eigen::Vector2d& sole_size);

/// Which of two soles, by Index(Side), has the corner that is nearest to this one.
Side SoleWithCorner(const std::array<Pose2, 2>& soles, const Eigen::Vector2d& sole_size,
                    const Eigen::Vector2d& corner);

}  // namespace halfstep
