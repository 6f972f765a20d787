#pragma once

#include <Eigen/Core>
#include <vector>

namespace halfstep::plot {

/// A line with fewer points of which no point of the given one is farther than `tolerance`; each
/// stretch between points that are not finite by itself. The method is that of Douglas and Peucker.
std::vector<Eigen::Vector2d> Thinned(const std::vector<Eigen::Vector2d>& points, double tolerance);

}  // namespace halfstep::plot
