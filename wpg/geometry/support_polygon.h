#pragma once

#include <Eigen/Core>
#include <array>

#include "wpg/geometry/pose2.h"

namespace halfstep {

/// Convex support polygon of one or two soles on the floor (at most 8 corners), counter-clockwise.
class SupportPolygon {
 public:
  /// One sole: a rectangle of full length and width `sole_size` [m], centred at X_WS.
  SupportPolygon(const Pose2& X_WS, const Eigen::Vector2d& sole_size);
  /// Two soles: their convex hull.
  SupportPolygon(const Pose2& X_WL, const Pose2& X_WR, const Eigen::Vector2d& sole_size);

  int size() const { return size_; }  ///< number of corners, 4 to 8
  /// Corner i, counter-clockwise, in W [m].
  Eigen::Vector2d corner(int i) const { return corners_.col(i); }

  /// Least distance inside the edges' lines [m]: positive inside, where it is the distance to the
  /// boundary; negative outside, where it is no more than minus the distance to the nearest edge
  /// line.
  double Margin(const Eigen::Vector2d& p_W) const;

 private:
  Eigen::Matrix<double, 2, 8> corners_;
  int size_ = 0;
};

/// Corners of a sole rectangle (2×4), counter-clockwise [m].
Eigen::Matrix<double, 2, 4> SoleCorners(const Pose2& X_WS, const Eigen::Vector2d& sole_size);

}  // namespace halfstep
