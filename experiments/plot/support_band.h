#pragma once

#include <vector>

#include "experiments/plot/plotted_run.h"

namespace halfstep::plot {

/// An interval of one coordinate in W [m]; NaN where it is empty.
struct SupportBand {
  double low = 0.0;   ///< where it begins
  double high = 0.0;  ///< where it ends
};

/// At each row of a walk between which numbers coordinate `k` (0: x, 1: y) of the ZMP may be, where
/// its other coordinate is what it is: there the ZMP is inside the polygon of the soles that stand,
/// seen from above, by `demanded` [m] or more.
std::vector<SupportBand> SupportBands(const PlottedWalk& walk, const Eigen::Vector2d& sole_size,
                                      int k, double demanded);

}  // namespace halfstep::plot
