#include "smoothing/interval_statements.h"

#include <algorithm>
#include <cmath>

#include "wpg/support_polygon.h"

namespace halfstep {
namespace {

constexpr std::array<MarginFamily, 9> kScalarFamilies = {
    MarginFamily::kFloor,      MarginFamily::kFootSpeed, MarginFamily::kFootYawRate,
    MarginFamily::kZmp,        MarginFamily::kReach,     MarginFamily::kJoint,
    MarginFamily::kJointSpeed, MarginFamily::kGround,    MarginFamily::kNoStep};

// Added to every bound, in its unit, for the rounding of postures and margins: on random intervals
// the truth exceeded the bounds of places, which can be zero, by up to 2e-15 m.
constexpr double kRounding = 1e-12;

}  // namespace

IntervalStatements::IntervalStatements(const MarginEvaluator& evaluator)
    : evaluator_(evaluator), bounds_(evaluator.robot()) {}

Pending IntervalStatements::All() const {
  Pending pending;
  pending.families.assign(kScalarFamilies.begin(), kScalarFamilies.end());
  for (size_t b = 0; b < evaluator_.clearances().num_bodies(); ++b) {
    pending.bodies.push_back(static_cast<uint16_t>(b));
  }
  for (size_t p = 0; p < evaluator_.clearances().num_pairs(); ++p) {
    pending.pairs.push_back(static_cast<uint16_t>(p));
  }
  return pending;
}

int IntervalStatements::CountOf(MarginFamily family) const {
  switch (family) {
    case MarginFamily::kReach:
    case MarginFamily::kNoStep:
      return 2;
    case MarginFamily::kJoint:
    case MarginFamily::kJointSpeed:
      return 12;
    case MarginFamily::kGround:
    case MarginFamily::kClearance:
      return static_cast<int>(evaluator_.robot().bodies.size());
    case MarginFamily::kSelfClearance:
      return static_cast<int>(evaluator_.clearances().num_pairs());
    case MarginFamily::kFloor:
    case MarginFamily::kFootSpeed:
    case MarginFamily::kFootYawRate:
    case MarginFamily::kZmp:
      return 1;
  }
  return 0;
}

void IntervalStatements::Tightest::Add(const Margin& added, double change) {
  const double spare = added.value - change;
  // What is not a number stays, and meets no demand.
  if (count++ == 0 || std::isnan(spare) || spare < margin.value - bound) {
    margin = added;
    bound = change;
  }
}

bool IntervalStatements::Tightest::Pass(double spare) {
  if (count == 0 || !(spare >= margin.value - bound)) return false;
  ++count;
  return true;
}

IntervalStatements::Tightest IntervalStatements::Ground(const SuperposedWalk& walk,
                                                        const LocalTime& mid,
                                                        const IntervalMotion& motion) const {
  const BodyHeights& heights = evaluator_.heights();
  const WalkVector& x = motion.jet.value;
  const double h = motion.half_width, t = walk.Absolute(mid);
  const int step = walk.StepInAir(mid);
  Tightest tightest;
  const auto add = [&](double value, double change, int body) {
    tightest.Add({.family = MarginFamily::kGround, .value = value, .subject = body},
                 change + kRounding);
  };
  for (int body : heights.on_feet()) {
    const Side side = static_cast<Side>(evaluator_.robot().bodies[static_cast<size_t>(body)].leg);
    const int z = FootIndex(side) + 2;
    double least = x[z] - motion.Change(z);
    if (step >= 0 && walk.half_step(2 * step).swing() == side) {
      least = std::max(least, walk.LeastHeight(step, t - h, t + h));
    }
    // On the floor or above it for all t, below it at the midpoint, or neither is known.
    const double margin = heights.OnFoot(body, x);
    const bool open = least < -kSoleRounding && margin > 0.0;
    add(open ? std::nan("") : margin, 0.0, body);
  }
  for (int body : heights.of_legs()) {
    const double change = motion.displacement[static_cast<size_t>(body)];
    const double possible = heights.LowestPossible(body, motion.posture);
    if (tightest.Pass(possible - change - kRounding)) continue;
    add(heights.LowestPoint(body, motion.posture).z(), change, body);
  }
  add(heights.of_waist().value, 0.0, heights.of_waist().subject);
  tightest.count = CountOf(MarginFamily::kGround);  // the lowest of the waist's bodies for all
  return tightest;
}

IntervalStatements::Tightest IntervalStatements::NoStep(const SuperposedWalk& walk,
                                                        const LocalTime& mid,
                                                        const IntervalMotion& motion,
                                                        MarginEvaluator::Scratch* scratch) const {
  Tightest tightest;
  for (Side side : {Side::kLeft, Side::kRight}) {
    // A sole that stands does not move: its quantities change by 0 and rounding.
    const int foot = FootIndex(side);
    const double moved = std::hypot(motion.Change(foot), motion.Change(foot + 1)) +
                         evaluator_.no_step_areas().sole_reach() * motion.Change(foot + 3);
    const Margin margin = evaluator_.NoStep(walk, mid, motion.jet.value, side, scratch);
    tightest.Add(margin, (std::isinf(margin.value) ? 0.0 : moved) + kRounding);
  }
  return tightest;
}

IntervalStatements::Tightest IntervalStatements::Scalar(MarginFamily family,
                                                        const SuperposedWalk& walk,
                                                        const LocalTime& mid,
                                                        const IntervalMotion& motion) const {
  constexpr double kUnlimited = std::numeric_limits<double>::infinity();
  const RobotModel& robot = evaluator_.robot();
  const MarginLimits& limits = evaluator_.limits();
  const WalkJet& jet = motion.jet;
  const double h = motion.half_width;
  const int step = walk.StepInAir(mid);
  const Side swing = step >= 0 ? walk.half_step(2 * step).swing() : Side::kLeft;
  const int foot = FootIndex(swing);
  const int subject = step >= 0 ? Index(swing) : -1;
  Tightest tightest;
  const auto add = [&](double value, double change, int of) {
    tightest.Add({.family = family, .value = value, .subject = of}, change + kRounding);
  };
  switch (family) {
    case MarginFamily::kFloor:
      if (step >= 0 && walk.MovesHorizontally(step, mid)) {
        add(jet.value[foot + 2], motion.Change(foot + 2), subject);
      } else {
        add(kUnlimited, 0.0, -1);
      }
      break;
    case MarginFamily::kFootSpeed:
      if (step >= 0 && limits.foot_speed) {
        add(*limits.foot_speed - jet.first.segment<3>(foot).norm(),
            h * motion.second.segment<3>(foot).norm(), subject);
      } else {
        add(kUnlimited, 0.0, -1);
      }
      break;
    case MarginFamily::kFootYawRate:
      if (step >= 0 && limits.foot_yaw_rate) {
        add(*limits.foot_yaw_rate - std::abs(jet.first[foot + 3]), motion.RateChange(foot + 3),
            subject);
      } else {
        add(kUnlimited, 0.0, -1);
      }
      break;
    case MarginFamily::kZmp: {
      const SupportPolygon polygon = SupportAt(walk, mid, jet.value, robot.sole_size);
      add(polygon.Margin(jet.value.segment<2>(kZmpX)),
          h * (jet.first.segment<2>(kZmpX).norm() +
               0.5 * h * motion.second.segment<2>(kZmpX).norm()),
          step);
      break;
    }
    case MarginFamily::kReach:
      for (int s = 0; s < 2; ++s) {
        add(motion.posture.ik[static_cast<size_t>(s)].reach_margin,
            motion.leg_length_change[static_cast<size_t>(s)], 6 * s + 3);
      }
      break;
    case MarginFamily::kJoint:
    case MarginFamily::kJointSpeed:
      for (int s = 0; s < 2; ++s) {
        const size_t i = static_cast<size_t>(s);
        const Vector6d& speed = motion.posture.speeds[i];
        const Vector6d& acceleration = motion.joints[i].acceleration;
        for (int j = 0; j < 6; ++j) {
          const LegJoint& joint = robot.legs[i].joints[static_cast<size_t>(j)];
          const double q = motion.posture.ik[i].q[j];
          if (family == MarginFamily::kJoint) {
            add(std::min(q - joint.lower, joint.upper - q),
                h * (std::abs(speed[j]) + 0.5 * h * acceleration[j]), 6 * s + j);
          } else {
            add(limits.joint_speed_scale * joint.max_speed - std::abs(speed[j]),
                h * acceleration[j], 6 * s + j);
          }
        }
      }
      break;
    case MarginFamily::kGround:
    case MarginFamily::kNoStep:
    case MarginFamily::kSelfClearance:
    case MarginFamily::kClearance:
      break;  // in Prove
  }
  return tightest;
}

std::optional<Margin> IntervalStatements::Prove(const SuperposedWalk& walk, double begin,
                                                double end, Pending* pending,
                                                MarginEvaluator::Scratch* scratch,
                                                Certificate* rows) const {
  ++scratch->instants;
  IntervalMotion motion;
  BoundMotion(bounds_, walk, begin, end, &motion);
  const LocalTime mid = walk.Locate(0.5 * (begin + end));
  if (!motion.bounded) {
    // Out of reach, or stretched: is it so at the midpoint, or only perhaps around it?
    return evaluator_.FirstViolation(walk, mid, scratch);
  }
  const MarginLimits& limits = evaluator_.limits();
  const auto located = [&](Margin margin) {
    margin.at = mid;
    margin.t = 0.5 * (begin + end);
    return margin;
  };
  const auto record = [&](const Tightest& tightest) {
    if (rows == nullptr || tightest.count == 0) return;
    rows->push_back({begin, end, tightest.margin.family, tightest.count, located(tightest.margin),
                     tightest.bound});
  };

  std::optional<Margin> violated;
  std::erase_if(pending->families, [&](MarginFamily family) {
    const Tightest tightest = family == MarginFamily::kGround   ? Ground(walk, mid, motion)
                              : family == MarginFamily::kNoStep ? NoStep(walk, mid, motion, scratch)
                                                                : Scalar(family, walk, mid, motion);
    const double demanded = limits.demanded_of(family);
    if (tightest.margin.value < demanded && !violated) violated = located(tightest.margin);
    const bool holds = tightest.margin.value - tightest.bound >= demanded;
    if (holds) record(tightest);
    return holds;
  });
  if (violated) return violated;

  const BodyClearances& clearances = evaluator_.clearances();
  BodyClearances::Scratch& bodies = scratch->bodies;
  const double horizon = limits.clearance_horizon;
  Tightest obstacles, pairs;
  const double obstacle_demanded = limits.demanded_of(MarginFamily::kClearance);
  std::erase_if(pending->bodies, [&](uint16_t body) {
    if (violated) return false;
    const double bound = motion.displacement[body] + kRounding;
    if (clearances.BodyClears(body, motion.posture, obstacle_demanded + bound, &bodies)) {
      if (rows != nullptr) {
        const double enough = std::max(horizon, obstacle_demanded + bound + kRounding);
        obstacles.Add(clearances.OfBody(body, motion.posture, enough, &bodies), bound);
      }
      return true;
    }
    if (!clearances.BodyClears(body, motion.posture, obstacle_demanded, &bodies)) {
      violated = located(clearances.OfBody(body, motion.posture, 1.0, &bodies));
    }
    return false;
  });
  record(obstacles);
  if (violated) return violated;

  clearances.Place(motion.posture, &bodies);
  const double self_demanded = limits.demanded_of(MarginFamily::kSelfClearance);
  std::erase_if(pending->pairs, [&](uint16_t pair) {
    if (violated) return false;
    const auto [i, j] = evaluator_.robot().self_pairs[pair];
    const size_t a = static_cast<size_t>(i), b = static_cast<size_t>(j);
    const double bound = std::min(motion.displacement[a] + motion.displacement[b],
                                  motion.displacement_B[a] + motion.displacement_B[b]) +
                         kRounding;
    if (clearances.PairClears(pair, motion.posture, self_demanded + bound, &bodies)) {
      if (rows != nullptr) {
        const double enough = std::max(horizon, self_demanded + bound + kRounding);
        pairs.Add(clearances.OfPair(pair, motion.posture, enough, &bodies), bound);
      }
      return true;
    }
    if (!clearances.PairClears(pair, motion.posture, self_demanded, &bodies)) {
      violated = located(clearances.OfPair(pair, motion.posture, 1.0, &bodies));
    }
    return false;
  });
  record(pairs);
  return violated;
}

void BoundMotion(const MotionBounds& bounds, const SuperposedWalk& walk, double begin, double end,
                 IntervalMotion* motion) {
  bounds.Bound(walk.At(0.5 * (begin + end)), walk.SecondBounds(begin, end), 0.5 * (end - begin),
               motion);
}

}  // namespace halfstep
