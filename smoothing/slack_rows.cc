#include "smoothing/slack_rows.h"

#include <algorithm>
#include <cmath>

#include "wpg/support_polygon.h"

namespace halfstep {

SlackEvaluator::SlackEvaluator(const MarginEvaluator& evaluator, double cutoff)
    : evaluator_(evaluator), cutoff_(cutoff), scratch_(evaluator.MakeScratch()) {}

template <typename Derivative>
void SlackEvaluator::Add(MarginFamily family, double margin, const Derivative& derivative,
                         InstantSlacks* out) {
  const double scale = Scale(family);
  const double slack = (margin - evaluator_.limits().demanded_of(family)) / scale;
  if (slack > cutoff_) return;
  out->rows.push_back({family, slack});
  if (!gradient_) return;
  for (size_t i = 0; i < sensitivities_.size(); ++i) {
    gradient_rows_.push_back(derivative(i) / scale);
  }
}

void SlackEvaluator::AddFoot(const SuperposedWalk& walk, const LocalTime& at, const WalkJet& jet,
                             InstantSlacks* out) {
  const int step = walk.StepInAir(at);
  if (step < 0) return;
  const MarginLimits& limits = evaluator_.limits();
  const int foot = FootIndex(walk.half_step(2 * step).swing());
  if (walk.MovesHorizontally(step, at)) {
    Add(
        MarginFamily::kFloor, jet.value[foot + 2],
        [&](size_t i) { return sensitivities_[i].jet.value[foot + 2]; }, out);
  }
  const Eigen::Vector3d velocity = jet.first.segment<3>(foot);
  const double speed = velocity.norm();
  if (limits.foot_speed && speed > 1e-6) {
    Add(
        MarginFamily::kFootSpeed, *limits.foot_speed - speed,
        [&](size_t i) {
          return -velocity.dot(sensitivities_[i].jet.first.segment<3>(foot)) / speed;
        },
        out);
  }
  const double yaw_rate = jet.first[foot + 3];
  if (limits.foot_yaw_rate && yaw_rate != 0.0) {
    Add(
        MarginFamily::kFootYawRate, *limits.foot_yaw_rate - std::abs(yaw_rate),
        [&](size_t i) {
          return yaw_rate < 0.0 ? sensitivities_[i].jet.first[foot + 3]
                                : -sensitivities_[i].jet.first[foot + 3];
        },
        out);
  }
}

void SlackEvaluator::AddZmp(const SuperposedWalk& walk, const LocalTime& at, const WalkJet& jet,
                            InstantSlacks* out) {
  const SupportPolygon polygon = SupportAt(walk, at, jet.value, evaluator_.robot().sole_size);
  for (int i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d a = polygon.corner(i);
    const Eigen::Vector2d edge = polygon.corner((i + 1) % polygon.size()) - a;
    if (edge.norm() < 1e-9) continue;
    const Eigen::Vector2d inward = Eigen::Vector2d(-edge.y(), edge.x()).normalized();
    Add(
        MarginFamily::kZmp, inward.dot(jet.value.segment<2>(kZmpX) - a),
        [&](size_t p) { return inward.dot(sensitivities_[p].jet.value.segment<2>(kZmpX)); }, out);
  }
}

void SlackEvaluator::AddJoints(const Posture& posture, InstantSlacks* out) {
  const RobotModel& robot = evaluator_.robot();
  for (size_t s = 0; s < 2; ++s) {
    const Leg& leg = robot.legs[s];
    const Eigen::Vector3d hip_to_ankle =
        posture.frames[s].X_BLink[5] * (leg.joints[5].X_BLink.inverse() * leg.ankle_B) - leg.hip_B;
    const Eigen::Vector3d along = hip_to_ankle.normalized();
    const Eigen::Vector3d ankle_from_sole =
        hip_to_ankle + leg.hip_B - posture.frames[s].X_BLink[6].translation();
    Add(
        MarginFamily::kReach, posture.ik[s].reach_margin,
        [&](size_t i) {
          const PostureTangent& t = tangents_[i];
          const double turn =
              sensitivities_[i].jet.value[FootIndex(static_cast<Side>(s)) + 3] - t.waist_yaw;
          return -along.dot(t.sole_B[s] + turn * Eigen::Vector3d::UnitZ().cross(ankle_from_sole));
        },
        out);
    for (int j = 0; j < 6; ++j) {
      const LegJoint& joint = leg.joints[static_cast<size_t>(j)];
      const double q = posture.ik[s].q[j], speed = posture.speeds[s][j];
      Add(
          MarginFamily::kJoint, q - joint.lower, [&](size_t i) { return tangents_[i].q[s][j]; },
          out);
      Add(
          MarginFamily::kJoint, joint.upper - q, [&](size_t i) { return -tangents_[i].q[s][j]; },
          out);
      const double limit = evaluator_.limits().joint_speed_scale * joint.max_speed;
      const double sign = speed < 0.0 ? -1.0 : 1.0;
      Add(
          MarginFamily::kJointSpeed, limit - std::abs(speed),
          [&](size_t i) { return -sign * tangents_[i].speeds[s][j]; }, out);
    }
  }
}

void SlackEvaluator::AddGround(const Posture& posture, InstantSlacks* out) {
  const BodyHeights& heights = evaluator_.heights();
  const double horizon = evaluator_.limits().demanded_of(MarginFamily::kGround) +
                         cutoff_ * Scale(MarginFamily::kGround);
  for (int b : heights.of_legs()) {
    if (heights.LowestPossible(b, posture) > horizon) continue;
    const RobotBody& body = evaluator_.robot().bodies[static_cast<size_t>(b)];
    const Eigen::Vector3d lowest = heights.LowestPoint(b, posture);
    Add(
        MarginFamily::kGround, lowest.z(),
        [&](size_t i) { return PointTangent(body, posture, tangents_[i], lowest).z(); }, out);
  }
}

void SlackEvaluator::AddClearances(const Posture& posture, InstantSlacks* out) {
  const RobotModel& robot = evaluator_.robot();
  const BodyClearances& clearances = evaluator_.clearances();
  const auto horizon = [&](MarginFamily family) {
    return evaluator_.limits().demanded_of(family) + cutoff_ * Scale(family);
  };
  const double far = horizon(MarginFamily::kClearance);
  for (size_t b = 0; b < robot.bodies.size(); ++b) {
    if (clearances.BodyClears(b, posture, far, &scratch_.bodies)) continue;
    const auto nearest = clearances.NearestTo(b, posture, far, &scratch_.bodies);
    if (nearest.obstacle < 0) continue;
    const Separation& gap = nearest.separation;
    Add(
        MarginFamily::kClearance, gap.distance,
        [&](size_t i) {
          return gap.normal_W.dot(
              PointTangent(robot.bodies[b], posture, tangents_[i], gap.point_a_W));
        },
        out);
  }
  clearances.Place(posture, &scratch_.bodies);
  const double near = horizon(MarginFamily::kSelfClearance);
  for (size_t p = 0; p < robot.self_pairs.size(); ++p) {
    if (clearances.PairClears(p, posture, near, &scratch_.bodies)) continue;
    const Separation gap = clearances.SeparationOf(p, posture, &scratch_.bodies);
    const auto [a, b] = robot.self_pairs[p];
    const RobotBody& first = robot.bodies[static_cast<size_t>(a)];
    const RobotBody& second = robot.bodies[static_cast<size_t>(b)];
    Add(
        MarginFamily::kSelfClearance, gap.distance,
        [&](size_t i) {
          return gap.normal_W.dot(PointTangent(first, posture, tangents_[i], gap.point_a_W) -
                                  PointTangent(second, posture, tangents_[i], gap.point_b_W));
        },
        out);
  }
}

void SlackEvaluator::At(const SuperposedWalk& walk, const LocalTime& at,
                        const std::vector<std::pair<HomotopyParameter, double>>& moving,
                        bool gradient, InstantSlacks* out) {
  ++scratch_.instants;
  gradient_ = gradient;
  out->rows.clear();
  out->parameters.clear();
  gradient_rows_.clear();
  sensitivities_.clear();
  tangents_.clear();
  const WalkJet jet = walk.At(at);
  Posture posture = SolvePosture(evaluator_.robot(), jet.value);
  const bool regular = posture.reachable && SolveJointSpeeds(evaluator_.robot(), jet, &posture);
  if (gradient) {
    walk.Sensitivities(at, &sensitivities_);
    for (const auto& [parameter, rate] : moving) {
      auto found = std::find_if(sensitivities_.begin(), sensitivities_.end(),
                                [&](const WalkSensitivity& s) { return s.parameter == parameter; });
      if (found == sensitivities_.end()) {
        sensitivities_.push_back({parameter, {}});
        found = sensitivities_.end() - 1;
      }
      found->jet.value += rate * jet.first;
      found->jet.first += rate * jet.second;
    }
    for (const WalkSensitivity& s : sensitivities_) {
      out->parameters.push_back(s.parameter);
      if (regular) {
        tangents_.push_back(Differentiate(evaluator_.robot(), jet, posture, s.jet));
      }
    }
  }
  AddFoot(walk, at, jet, out);
  AddZmp(walk, at, jet, out);
  if (regular) {
    AddJoints(posture, out);
    AddGround(posture, out);
    AddClearances(posture, out);
  } else {
    const double reach = std::min(posture.ik[0].reach_margin, posture.ik[1].reach_margin);
    Add(
        MarginFamily::kReach, std::min(reach, 0.0) - 1e-3, [](size_t) { return 0.0; }, out);
  }
  if (gradient) {
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    out->gradient = Eigen::Map<const RowMajor>(gradient_rows_.data(),
                                               static_cast<Eigen::Index>(out->rows.size()),
                                               static_cast<Eigen::Index>(sensitivities_.size()));
  }
}

}  // namespace halfstep
