#include "smoothing/margin_evaluator.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "wpg/support_polygon.h"

namespace halfstep {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Margin& Of(MarginSet* margins, MarginFamily family) {
  return (*margins)[static_cast<size_t>(family)];
}

// Keeps the smaller of the margin there and a new one.
void Lower(MarginSet* margins, MarginFamily family, double value, int subject, int other = -1) {
  Margin& margin = Of(margins, family);
  if (!(value >= margin.value)) {
    margin.value = std::isnan(value) ? -kInfinity : value;
    margin.subject = subject;
    margin.other = other;
  }
}

MarginSet Unlimited() {
  MarginSet margins;
  for (MarginFamily family : AllMarginFamilies()) Of(&margins, family).family = family;
  return margins;
}

}  // namespace

MarginEvaluator::Place::Place(RobotModel r, Scene s)
    : robot(std::move(r)),
      scene(std::move(s)),
      clearances(robot, scene),
      heights(robot),
      areas(scene, robot.sole_outline) {}

MarginEvaluator::MarginEvaluator(RobotModel robot, Scene scene, MarginLimits limits)
    : place_(std::make_shared<const Place>(std::move(robot), std::move(scene))), limits_(limits) {}

MarginEvaluator MarginEvaluator::WithLimits(const MarginLimits& limits) const {
  MarginEvaluator other = *this;
  other.limits_ = limits;
  return other;
}

void MarginEvaluator::FootMargins(const SuperposedWalk& walk, const LocalTime& at,
                                  const WalkJet& jet, MarginSet* margins) const {
  const int step = walk.StepInAir(at);
  if (step < 0) return;
  const Side swing = walk.half_step(2 * step).swing();
  const int i = FootIndex(swing);
  const Eigen::Vector4d rate = jet.first.segment<4>(i);
  const int subject = Index(swing);
  // Before its horizontal motion begins and after it ends, the foot may touch the floor.
  if (walk.MovesHorizontally(step, at)) {
    Lower(margins, MarginFamily::kFloor, jet.value[i + 2], subject);
  }
  if (limits_.foot_speed) {
    Lower(margins, MarginFamily::kFootSpeed, *limits_.foot_speed - rate.head<3>().norm(), subject);
  }
  if (limits_.foot_yaw_rate) {
    Lower(margins, MarginFamily::kFootYawRate, *limits_.foot_yaw_rate - std::abs(rate[3]), subject);
  }
}

void MarginEvaluator::ZmpMargin(const SuperposedWalk& walk, const LocalTime& at, const WalkJet& jet,
                                MarginSet* margins) const {
  const SupportPolygon polygon = SupportAt(walk, at, jet.value, robot().sole_size);
  Lower(margins, MarginFamily::kZmp, polygon.Margin(jet.value.segment<2>(kZmpX)),
        walk.StepInAir(at));
}

Margin MarginEvaluator::NoStep(const SuperposedWalk& walk, const LocalTime& at, const WalkVector& x,
                               Side side, Scratch* scratch) const {
  Margin margin{.family = MarginFamily::kNoStep, .subject = Index(side)};
  if (no_step_areas().empty() || walk.InAir(at, side)) return margin;
  Scratch::Standing& standing = scratch->standing[static_cast<size_t>(Index(side))];
  const Pose2 X_WF = FootPose(x, side);
  if (!standing.known || standing.X_WF != X_WF) {
    standing = {X_WF, no_step_areas().NearestTo(X_WF), true};
  }
  margin.value = standing.nearest.distance;
  margin.other = standing.nearest.area;
  return margin;
}

void MarginEvaluator::NoStepMargins(const SuperposedWalk& walk, const LocalTime& at,
                                    const WalkVector& x, Scratch* scratch,
                                    MarginSet* margins) const {
  for (Side side : {Side::kLeft, Side::kRight}) {
    const Margin margin = NoStep(walk, at, x, side, scratch);
    Lower(margins, MarginFamily::kNoStep, margin.value, margin.subject, margin.other);
  }
}

void MarginEvaluator::JointMargins(const Posture& posture, MarginSet* margins) const {
  for (int s = 0; s < 2; ++s) {
    const Leg& leg = robot().legs[static_cast<size_t>(s)];
    const LegIkSolution& ik = posture.ik[static_cast<size_t>(s)];
    Lower(margins, MarginFamily::kReach, ik.reach_margin, 6 * s + 3);
    if (ik.status != LegIkStatus::kSolved) {
      Lower(margins, MarginFamily::kJoint, -kInfinity, 6 * s + 3);
      continue;
    }
    for (int j = 0; j < 6; ++j) {
      const LegJoint& joint = leg.joints[static_cast<size_t>(j)];
      const double margin = std::min(ik.q[j] - joint.lower, joint.upper - ik.q[j]);
      Lower(margins, MarginFamily::kJoint, margin, 6 * s + j);
    }
  }
}

MarginSet MarginEvaluator::At(const SuperposedWalk& walk, const LocalTime& at,
                              Scratch* scratch) const {
  ++scratch->instants;
  const WalkJet jet = walk.At(at);
  MarginSet margins = Unlimited();
  FootMargins(walk, at, jet, &margins);
  NoStepMargins(walk, at, jet.value, scratch, &margins);
  ZmpMargin(walk, at, jet, &margins);
  Posture posture = SolvePosture(robot(), jet.value);
  JointMargins(posture, &margins);
  if (posture.reachable) {
    JointSpeedMargins(jet, &posture, &margins);
    Of(&margins, MarginFamily::kGround) = heights().Least(posture, jet.value);
    const double horizon =
        std::max({limits_.clearance_horizon, 2.0 * limits_.demanded_of(MarginFamily::kClearance),
                  2.0 * limits_.demanded_of(MarginFamily::kSelfClearance)});
    Of(&margins, MarginFamily::kClearance) =
        clearances().NearestObstacle(posture, horizon, &scratch->bodies);
    Of(&margins, MarginFamily::kSelfClearance) =
        clearances().NearestPair(posture, horizon, &scratch->bodies);
  } else {
    for (MarginFamily family : {MarginFamily::kJointSpeed, MarginFamily::kGround,
                                MarginFamily::kClearance, MarginFamily::kSelfClearance}) {
      Lower(&margins, family, -kInfinity, -1);
    }
  }
  const double t = walk.Absolute(at);
  for (Margin& margin : margins) {
    margin.at = at;
    margin.t = t;
  }
  return margins;
}

std::optional<Margin> MarginEvaluator::FirstViolation(const SuperposedWalk& walk,
                                                      const LocalTime& at, Scratch* scratch) const {
  ++scratch->instants;
  const WalkJet jet = walk.At(at);
  MarginSet margins = Unlimited();
  const auto located = [&](Margin margin) {
    margin.at = at;
    margin.t = walk.Absolute(at);
    return margin;
  };
  const auto violated = [&]() -> std::optional<Margin> {
    for (const Margin& margin : margins) {
      if (!(margin.value >= limits_.demanded_of(margin.family))) return located(margin);
    }
    return std::nullopt;
  };
  FootMargins(walk, at, jet, &margins);
  NoStepMargins(walk, at, jet.value, scratch, &margins);
  ZmpMargin(walk, at, jet, &margins);
  if (const auto margin = violated()) return margin;
  Posture posture = SolvePosture(robot(), jet.value);
  JointMargins(posture, &margins);
  if (const auto margin = violated()) return margin;
  JointSpeedMargins(jet, &posture, &margins);
  Of(&margins, MarginFamily::kGround) =
      heights().Least(posture, jet.value, limits_.demanded_of(MarginFamily::kGround));
  if (const auto margin = violated()) return margin;
  const auto touching =
      clearances().FirstBelow(posture, limits_.demanded_of(MarginFamily::kClearance),
                              limits_.demanded_of(MarginFamily::kSelfClearance), &scratch->bodies);
  if (touching) return located(*touching);
  return std::nullopt;
}

void MarginEvaluator::JointSpeedMargins(const WalkJet& jet, Posture* posture,
                                        MarginSet* margins) const {
  if (!SolveJointSpeeds(robot(), jet, posture)) {
    Lower(margins, MarginFamily::kJointSpeed, -kInfinity, -1);
    return;
  }
  for (int s = 0; s < 2; ++s) {
    for (int j = 0; j < 6; ++j) {
      const LegJoint& joint = robot().legs[static_cast<size_t>(s)].joints[static_cast<size_t>(j)];
      const double speed = std::abs(posture->speeds[static_cast<size_t>(s)][j]);
      Lower(margins, MarginFamily::kJointSpeed, limits_.joint_speed_scale * joint.max_speed - speed,
            6 * s + j);
    }
  }
}

std::string MarginEvaluator::Subject(const Margin& margin) const {
  const auto body = [&](int b) {
    return b < 0 ? std::string("robot") : robot().bodies[static_cast<size_t>(b)].name;
  };
  switch (margin.family) {
    case MarginFamily::kFloor:
    case MarginFamily::kFootSpeed:
    case MarginFamily::kFootYawRate:
      return margin.subject < 0 ? "both feet"
                                : std::string(Name(static_cast<Side>(margin.subject))) + " foot";
    case MarginFamily::kZmp:
      return margin.subject < 0 ? "both soles" : "support sole";
    case MarginFamily::kReach:
      return margin.subject < 6 ? "left leg" : "right leg";
    case MarginFamily::kJoint:
    case MarginFamily::kJointSpeed:
      if (margin.subject < 0) return "legs";
      return robot()
          .legs[static_cast<size_t>(margin.subject / 6)]
          .joints[static_cast<size_t>(margin.subject % 6)]
          .name;
    case MarginFamily::kSelfClearance:
      return body(margin.subject) + " - " + body(margin.other);
    case MarginFamily::kNoStep: {
      if (margin.subject < 0) return "both feet";
      const std::string foot = std::string(Name(static_cast<Side>(margin.subject))) + " foot";
      // As the scene file counts them.
      return margin.other < 0 ? foot : foot + " - no_step[" + std::to_string(margin.other) + "]";
    }
    case MarginFamily::kGround:
      return body(margin.subject);
    case MarginFamily::kClearance:
      return margin.other < 0 ? body(margin.subject)
                              : body(margin.subject) + " - " +
                                    scene().obstacles[static_cast<size_t>(margin.other)].name;
  }
  return "";
}

std::string MarginEvaluator::Describe(const Margin& margin) const {
  std::ostringstream out;
  out.precision(6);
  out << Name(margin.family) << " of " << Subject(margin);
  if (std::isnan(margin.value)) {
    out << " could not be decided";
  } else {
    out << " " << margin.value << " " << Unit(margin.family) << " (demanded "
        << limits_.demanded_of(margin.family) << ")";
  }
  out << " at half-step " << margin.at.half_step + 1 << ", tau = " << margin.at.tau << " s";
  return out.str();
}

}  // namespace halfstep
