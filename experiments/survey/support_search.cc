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
  const MarginLimits limits = DefaultLimits(robot);
  const auto of = [&robot](MarginFamily family) {
    return LeastInSixSteps(robot, family, kSupportPeriod);
  };
  robot.support_point = 0.0;
  found.before = found.after = of(MarginFamily::kZmpRobot);
  double slack = found.before - limits.demanded_of(MarginFamily::kZmpRobot);
  if (slack >= 0.0) return found;
  for (const double direction : {-1.0, 1.0}) {
    for (int i = 1; i * kSupportStep < 0.5 * robot.sole_size.y(); ++i) {
      robot.support_point = direction * i * kSupportStep;
      const double own = of(MarginFamily::kZmpRobot);
      const double both = std::min(own - limits.demanded_of(MarginFamily::kZmpRobot),
                                   of(MarginFamily::kZmp) - limits.demanded_of(MarginFamily::kZmp));
      if (!(both > slack)) break;
      slack = both;
      found.after = own;
      found.offset = robot.support_point;
    }
    if (found.offset != 0.0) break;
  }
  return found;
}

}  // namespace halfstep
