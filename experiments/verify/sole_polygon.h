#pragma once

#include <Eigen/Core>
#include <vector>

#include "wpg/geometry/pose2.h"

namespace halfstep::verify {

/// What carries: the rectangle of one sole, or the convex hull of two, in W.
class SolePolygon {
 public:
  /// Soles of full length and width `size` [m].
  SolePolygon(const std::vector<Pose2>& soles, const Eigen::Vector2d& size);

  /// Least distance inside the lines of the edges [m]; negative outside.
  double Margin(const Eigen::Vector2d& p) const;
  /// How far one may go from p along an edge, either way, before the line of another: the farthest
  /// of all edges [m].
  double LongestWay(const Eigen::Vector2d& p) const;

 private:
  struct Edge {
    Eigen::Vector2d from, along;  // a corner [m]; a unit vector, counter-clockwise
  };
  std::vector<Edge> edges_;
};

}  // namespace halfstep::verify
