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
  if (value < margin.value || !std::isfinite(value)) {
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

MarginEvaluator::MarginEvaluator(RobotModel robot, Scene scene, MarginLimits limits)
    : robot_(std::move(robot)), scene_(std::move(scene)), limits_(limits), world_(scene_) {
  for (const RobotBody& body : robot_.bodies) shapes_.emplace_back(body.shape);
}

MarginEvaluator::Scratch MarginEvaluator::MakeScratch() const {
  Scratch scratch;
  scratch.bodies.resize(robot_.bodies.size());
  scratch.pair_normals_W.assign(robot_.self_pairs.size(), Eigen::Vector3d::UnitY());
  return scratch;
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
  const int step = walk.StepInAir(at);
  const SupportPolygon polygon =
      step >= 0 ? SupportPolygon(walk.X_WS(2 * step), robot_.sole_size)
                : SupportPolygon(FootPose(jet.value, Side::kLeft),
                                 FootPose(jet.value, Side::kRight), robot_.sole_size);
  Lower(margins, MarginFamily::kZmp, polygon.Margin(jet.value.segment<2>(kZmpX)), step);
}

void MarginEvaluator::JointMargins(const Posture& posture, MarginSet* margins) const {
  for (int s = 0; s < 2; ++s) {
    const Leg& leg = robot_.legs[static_cast<size_t>(s)];
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

std::optional<Margin> MarginEvaluator::FirstCollision(const Posture& posture,
                                                      Scratch* scratch) const {
  const double clearance = limits_.demanded_of(MarginFamily::kClearance);
  for (size_t b = 0; b < shapes_.size(); ++b) {
    const Eigen::Isometry3d& X_WB = posture.OfBody(robot_.bodies[b]);
    ++scratch->counts.collision_queries;
    if (world_.Clears(shapes_[b], X_WB, clearance, &scratch->bodies[b])) continue;
    const auto nearest = world_.FindNearest(shapes_[b], X_WB, std::max(clearance, 1e-6));
    return Margin{.family = MarginFamily::kClearance,
                  .value = nearest.separation.distance,
                  .subject = static_cast<int>(b),
                  .other = nearest.obstacle};
  }
  const double self = limits_.demanded_of(MarginFamily::kSelfClearance);
  for (size_t p = 0; p < robot_.self_pairs.size(); ++p) {
    const auto [i, j] = robot_.self_pairs[p];
    const size_t a = static_cast<size_t>(i), b = static_cast<size_t>(j);
    const Eigen::Isometry3d& X_Wa = posture.OfBody(robot_.bodies[a]);
    const Eigen::Isometry3d& X_Wb = posture.OfBody(robot_.bodies[b]);
    ++scratch->counts.collision_queries;
    if (ClearsAlongCached(shapes_[a], X_Wa, shapes_[b], X_Wb, self, &scratch->pair_normals_W[p])) {
      continue;
    }
    return Margin{.family = MarginFamily::kSelfClearance,
                  .value = Separate(shapes_[a], X_Wa, shapes_[b], X_Wb).distance,
                  .subject = i,
                  .other = j};
  }
  return std::nullopt;
}

void MarginEvaluator::Clearances(const Posture& posture, Scratch* scratch,
                                 MarginSet* margins) const {
  double horizon = limits_.clearance_horizon;
  Lower(margins, MarginFamily::kClearance, horizon, -1);
  for (size_t b = 0; b < shapes_.size(); ++b) {
    ++scratch->counts.collision_queries;
    const auto nearest = world_.FindNearest(shapes_[b], posture.OfBody(robot_.bodies[b]), horizon);
    if (nearest.obstacle < 0) continue;
    Lower(margins, MarginFamily::kClearance, nearest.separation.distance, static_cast<int>(b),
          nearest.obstacle);
    horizon = std::min(horizon, std::max(nearest.separation.distance, 1e-9));
  }
  double best = limits_.clearance_horizon;
  Lower(margins, MarginFamily::kSelfClearance, best, -1);
  for (const auto& [i, j] : robot_.self_pairs) {
    const size_t a = static_cast<size_t>(i), b = static_cast<size_t>(j);
    const Eigen::Isometry3d& X_Wa = posture.OfBody(robot_.bodies[a]);
    const Eigen::Isometry3d& X_Wb = posture.OfBody(robot_.bodies[b]);
    const double apart = (X_Wa * shapes_[a].center() - X_Wb * shapes_[b].center()).norm() -
                         shapes_[a].radius() - shapes_[b].radius();
    if (apart >= best) continue;
    ++scratch->counts.collision_queries;
    const double distance = Separate(shapes_[a], X_Wa, shapes_[b], X_Wb).distance;
    best = std::min(best, distance);
    Lower(margins, MarginFamily::kSelfClearance, distance, i, j);
  }
}

MarginSet MarginEvaluator::At(const SuperposedWalk& walk, const LocalTime& at,
                              Scratch* scratch) const {
  ++scratch->counts.instants;
  const WalkJet jet = walk.At(at);
  MarginSet margins = Unlimited();
  FootMargins(walk, at, jet, &margins);
  ZmpMargin(walk, at, jet, &margins);
  Posture posture = SolvePosture(robot_, jet.value);
  JointMargins(posture, &margins);
  if (posture.reachable) {
    PlaceLinks(robot_, &posture);
    JointSpeedMargins(jet, &posture, &margins);
    Clearances(posture, scratch, &margins);
  } else {
    for (MarginFamily family :
         {MarginFamily::kJointSpeed, MarginFamily::kClearance, MarginFamily::kSelfClearance}) {
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
  ++scratch->counts.instants;
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
  ZmpMargin(walk, at, jet, &margins);
  if (const auto margin = violated()) return margin;
  Posture posture = SolvePosture(robot_, jet.value);
  JointMargins(posture, &margins);
  if (const auto margin = violated()) return margin;
  PlaceLinks(robot_, &posture);
  JointSpeedMargins(jet, &posture, &margins);
  if (const auto margin = violated()) return margin;
  if (const auto margin = FirstCollision(posture, scratch)) return located(*margin);
  return std::nullopt;
}

void MarginEvaluator::JointSpeedMargins(const WalkJet& jet, Posture* posture,
                                        MarginSet* margins) const {
  if (!SolveJointSpeeds(robot_, jet, posture)) {
    Lower(margins, MarginFamily::kJointSpeed, -kInfinity, -1);
    return;
  }
  for (int s = 0; s < 2; ++s) {
    for (int j = 0; j < 6; ++j) {
      const LegJoint& joint = robot_.legs[static_cast<size_t>(s)].joints[static_cast<size_t>(j)];
      const double speed = std::abs(posture->speeds[static_cast<size_t>(s)][j]);
      Lower(margins, MarginFamily::kJointSpeed, limits_.joint_speed_scale * joint.max_speed - speed,
            6 * s + j);
    }
  }
}

std::string MarginEvaluator::Subject(const Margin& margin) const {
  const auto body = [&](int b) {
    return b < 0 ? std::string("robot") : robot_.bodies[static_cast<size_t>(b)].name;
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
      return robot_.legs[static_cast<size_t>(margin.subject / 6)]
          .joints[static_cast<size_t>(margin.subject % 6)]
          .name;
    case MarginFamily::kSelfClearance:
      return body(margin.subject) + " - " + body(margin.other);
    case MarginFamily::kClearance:
      return margin.other < 0 ? body(margin.subject)
                              : body(margin.subject) + " - " +
                                    scene_.obstacles[static_cast<size_t>(margin.other)].name;
  }
  return "";
}

std::string MarginEvaluator::Describe(const Margin& margin) const {
  std::ostringstream out;
  out.precision(4);
  out << Name(margin.family) << " of " << Subject(margin) << " " << margin.value << " "
      << Unit(margin.family) << " (demanded " << limits_.demanded_of(margin.family)
      << ") at half-step " << margin.at.half_step + 1 << ", tau = " << margin.at.tau << " s";
  return out.str();
}

}  // namespace halfstep
