#pragma once

#include <string>
#include <vector>

#include "planner/ground/level_surface.h"
#include "wpg/geometry/pose2.h"

namespace halfstep {

/// A straight flight of stairs, upwards along x of its own frame.
struct Stairs {
  Pose2 X_WA;          ///< its frame A in W: the middle of the foot of the first riser
  double foot = 0.0;   ///< z of the foot of the first riser [m]
  double rise = 0.0;   ///< of each riser [m] > 0
  double run = 0.0;    ///< depth of each tread [m] > 0
  double width = 0.0;  ///< of the treads, half on either side of A [m] > 0
  int count = 1;       ///< of treads ≥ 1
};

/// The treads of a flight, NAME_1, NAME_2 …: the k-th is [(k − 1)·run, k·run] × ±width/2 in A, at
/// foot + k·rise, each solid down to `bottom` [m] < foot + rise.
std::vector<LevelSurface> TreadsOf(const std::string& name, const Stairs& stairs, double bottom);

}  // namespace halfstep
