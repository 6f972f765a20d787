#pragma once

#include <cmath>
#include <optional>

#include "smoothing/proof/interval_statements.h"
#include "smoothing/walk/superposed_walk.h"
#include "tests/smoothing/certificate_draws.h"
#include "tests/smoothing/test_walks.h"
#include "wpg/motion/posture.h"

namespace halfstep {

/// A random walk of a robot, not at the ends of its reach.
inline SuperposedWalk DrawnWalkOf(const RobotModel& robot, WalkDraw* draw) {
  const HalfStepSequence sequence = DrawSequence(robot, 2, {.stride = 0.7}, draw);
  return {sequence, draw->Parameters(sequence, 0.0, 0.8)};
}

/// The posture with its joint speeds; none where a leg does not reach, or comes so near to
/// stretched that differences have no room.
inline std::optional<Posture> MovingPosture(const RobotModel& robot, const WalkJet& jet) {
  Posture posture = SolvePosture(robot, jet.value);
  if (!posture.reachable || posture.ik[0].reach_margin < 0.01 ||
      posture.ik[1].reach_margin < 0.01 || !SolveJointSpeeds(robot, jet, &posture)) {
    return std::nullopt;
  }
  return posture;
}

/// Rates of all quantities by some parameter.
inline WalkJet DrawnRates(WalkDraw* draw) {
  WalkJet rates;
  for (int q = 0; q < kNumQuantities; ++q) {
    rates.value[q] = draw->Uniform(-0.1, 0.1);
    rates.first[q] = draw->Uniform(-1, 1);
    rates.second[q] = draw->Uniform(-10, 10);
  }
  return rates;
}

/// The jet at h of a parameter by which it has these rates.
inline WalkJet Along(WalkJet jet, double h, const WalkJet& rates) {
  jet.value += h * rates.value;
  jet.first += h * rates.first;
  jet.second += h * rates.second;
  return jet;
}

/// What a number with this gradient changes by along a tangent.
inline double Product(const WalkJet& gradient, const WalkJet& tangent) {
  return gradient.value.dot(tangent.value) + gradient.first.dot(tangent.first) +
         gradient.second.dot(tangent.second);
}

/// Calls visit(walk, begin, length, motion) of `each` intervals of 0.1 to 30 ms in each of `count`
/// walks with extreme overlaps.
template <typename Visit>
void VisitIntervals(const RobotModel& robot, int count, int each, WalkDraw* draw,
                    const Visit& visit) {
  const MotionBounds bounds(robot);
  for (int i = 0; i < count; ++i) {
    const HalfStepSequence sequence = DrawSequence(robot, 2, {}, draw);
    const SuperposedWalk walk(sequence, draw->ExtremeParameters(sequence));
    for (int k = 0; k < each; ++k) {
      const double length = 1e-4 * std::pow(300.0, draw->Uniform(0, 1));
      const double begin = draw->Uniform(0.0, walk.duration() - length);
      IntervalMotion motion;
      BoundMotion(bounds, walk, begin, begin + length, &motion);
      visit(walk, begin, length, motion);
    }
  }
}

}  // namespace halfstep
