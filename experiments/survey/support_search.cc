#include "experiments/survey/support_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "experiments/survey/self_gaps.h"
#include "experiments/survey/stance_search.h"
#include "smoothing/margins/margin_evaluator.h"
#include "smoothing/walk/superposed_walk.h"
#include "wpg/robot/torque_limits.h"

namespace halfstep {
namespace {

constexpr double kSupportPeriod = 0.01;  // [s]
constexpr double kSupportStep = 1e-3;    // of the offsets that are tried [m]

}  // namespace

double LeastInSixSteps(const RobotModel& robot, MarginFamily family, double period,
                       bool everywhere) {
  const HalfStepSequence sequence = SixSteps(robot, DefaultHalfStep(robot));
  const SuperposedWalk walk(sequence, PlannedMotion(sequence));
  const MarginEvaluator evaluator(robot, Scene{}, DefaultLimits(robot));
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  double least = std::numeric_limits<double>::infinity();
  for (double t = 0.0; t < walk.duration(); t += period) {
    Instant at(evaluator.place(), evaluator.limits(), walk, walk.Locate(t), &scratch);
    if (!everywhere && !at.regular()) continue;
    least = std::min(least, evaluator.statements(family).Least(&at, least).value);
  }
  return least;
}

FoundSupport FindSupport(RobotModel robot) {
  FoundSupport found;
  if (!robot.masses.fault.empty()) return found;
  std::vector<MarginFamily> families = {MarginFamily::kZmpRobot};
  if (TorqueFault(robot).empty()) families.push_back(MarginFamily::kTorque);
  const MarginLimits limits = DefaultLimits(robot);
  const auto least = [&] {
    double slack = std::numeric_limits<double>::infinity();
    for (const MarginFamily family : families) {
      const Margin margin{.family = family,
                          .value = LeastInSixSteps(robot, family, kSupportPeriod)};
      if (limits.Slack(margin) >= slack) continue;
      slack = limits.Slack(margin);
      found.missed = family;
    }
    return slack;
  };
  robot.support_point = 0.0;
  double best = least();
  const MarginFamily missed = found.missed;
  if (best < 0.0) {  // nor shall the offset cost what was not missed
    families.push_back(MarginFamily::kZmp);
    families.push_back(MarginFamily::kJoint);
  }
  for (const double direction : {-1.0, 1.0}) {
    if (best >= 0.0 || found.offset != 0.0) break;
    for (int i = 1; i * kSupportStep < 0.5 * robot.sole_size.y(); ++i) {
      robot.support_point = direction * i * kSupportStep;
      const double slack = least();
      if (!(slack > best)) break;
      best = slack;
      found.offset = robot.support_point;
    }
  }
  found.missed = missed;
  robot.support_point = 0.0;
  found.before = LeastInSixSteps(robot, missed, kSupportPeriod);
  robot.support_point = found.offset;
  found.after = LeastInSixSteps(robot, missed, kSupportPeriod);
  return found;
}

}  // namespace halfstep
