#include "experiments/survey/support_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/survey/self_gaps.h"
#include "experiments/survey/stance_search.h"
#include "smoothing/margins/margin_evaluator.h"
#include "smoothing/walk/superposed_walk.h"

namespace halfstep {
namespace {

constexpr double kSupportPeriod = 0.01;  // [s]
constexpr double kSupportStep = 1e-3;    // of the offsets that are tried [m]

}  // namespace

double LeastInSixSteps(const RobotModel& robot, MarginFamily family, double period) {
  const HalfStepSequence sequence = SixSteps(robot, DefaultHalfStep(robot));
  const SuperposedWalk walk(sequence, PlannedMotion(sequence));
  const MarginEvaluator evaluator(robot, Scene{}, DefaultLimits(robot));
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  double least = std::numeric_limits<double>::infinity();
  for (double t = 0.0; t < walk.duration(); t += period) {
    Instant at(evaluator.place(), evaluator.limits(), walk, walk.Locate(t), &scratch);
    least = std::min(least, evaluator.statements(family).Least(&at, least).value);
  }
  return least;
}

FoundSupport FindSupport(RobotModel robot) {
  FoundSupport found;
  if (!robot.masses.fault.empty()) return found;
  const auto zmp_of_robot = [&robot] {
    return LeastInSixSteps(robot, MarginFamily::kZmpRobot, kSupportPeriod);
  };
  robot.support_point = 0.0;
  found.before = found.after = zmp_of_robot();
  if (found.before >= DefaultLimits(robot).demanded_of(MarginFamily::kZmpRobot)) return found;
  for (const double direction : {-1.0, 1.0}) {
    for (int i = 1; i * kSupportStep < 0.5 * robot.sole_size.y(); ++i) {
      robot.support_point = direction * i * kSupportStep;
      const double both =
          std::min(LeastInSixSteps(robot, MarginFamily::kZmp, kSupportPeriod), zmp_of_robot());
      if (!(both > found.after)) break;
      found.after = both;
      found.offset = robot.support_point;
    }
    if (found.offset != 0.0) break;
  }
  return found;
}

}  // namespace halfstep
