#pragma once

#include <Eigen/Geometry>

#include "planner/scene/scene.h"

namespace halfstep::verify {

/// An obstacle in time, by its own formulas from the numbers of the scene file (planner/README.md,
/// "Obstacles that move"); none of the program's functions of time is used. Borrows the obstacle.
class ObstaclePath {
 public:
  /// No point is farther than `radius` [m] from the origin of the obstacle's frame.
  ObstaclePath(const Obstacle& obstacle, double radius) : obstacle_(obstacle), radius_(radius) {}

  /// Where it is said to be at t [s].
  Eigen::Isometry3d At(double t) const;
  /// How far from there any point may be at t [m].
  double Uncertainty(double t) const;
  /// A speed that bounds, on [begin, end], that of every point by the known motion and the change
  /// of the uncertainty together [m/s].
  double FastestWithin(double begin, double end) const;

 private:
  const Obstacle& obstacle_;
  double radius_;
};

}  // namespace halfstep::verify
