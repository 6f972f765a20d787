// Random obstacles that move.
#include <algorithm>

#include "tests/oracle/nasty_draws.h"

namespace halfstep::oracle {

void AddMotion(const ClosedFormWalk& walk, double size, Draw* draw, PlainObstacle* o) {
  const double D = walk.duration();
  const bool moves = draw->Chance(0.8);
  if (moves) {
    double t = 0;
    for (int n = 1 + draw->Below(4); n > 0; --n) {
      t += D * draw->Uniform(0.05, 0.5);
      const double away = size * draw->Uniform(0, 1.5);
      Eigen::Vector3d at = NearTheWay(walk, size, draw) + away * draw->Vector(-1, 1);
      at.z() = std::max(at.z(), 0.0);
      o->waypoints.push_back({.t = t, .xyz = at, .yaw_deg = draw->Uniform(-400, 400)});
    }
  }
  if (!moves || draw->Chance(0.5)) o->error = size * draw->Logarithmic(1e-4, 0.03);
  if (!moves || draw->Chance(0.5)) {
    o->speed = size * draw->Logarithmic(1e-4, 0.02);
    o->measured_at = draw->Uniform(-1, D);
    if (draw->Chance(0.5)) o->horizon = draw->Uniform(0, D);
  }
}

}  // namespace halfstep::oracle
