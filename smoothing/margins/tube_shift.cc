#include "smoothing/margins/tube_shift.h"

#include <algorithm>
#include <cmath>

#include "smoothing/margins/body_heights.h"
#include "smoothing/margins/tube_levers.h"

namespace halfstep {

TubeShift::TubeShift(const RobotModel& robot, const Tube& its_tube) : tube(its_tube) {
  const TubeLevers levers(robot);
  for (size_t b = 0; b < robot.bodies.size(); ++b) {
    bodies.push_back(levers.WayOf(b, tube));
    body = std::max(body, bodies.back());
    if (!IsOnFoot(robot.bodies[b])) off_feet = std::max(off_feet, bodies.back());
  }
  for (size_t p = 0; p < robot.self_pairs.size(); ++p) {
    pairs.push_back(levers.NearerBy(p, tube));
    pair = std::max(pair, pairs.back());
  }
  constexpr double kOutward = 1.0 + 1e-14;
  const double outline = std::sqrt(robot.sole_outline.colwise().squaredNorm().maxCoeff());
  sole = kOutward * (tube.foot + tube.foot_turn * outline);
}

}  // namespace halfstep
