#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "smoothing/walk/superposed_walk.h"
#include "wpg/geometry/convex_body.h"
#include "wpg/motion/motion_bounds.h"
#include "wpg/motion/posture.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// Points of each body, in its link's frame, that are farthest out in many directions: every vertex
/// and 26 support points.
inline std::vector<Eigen::Matrix3Xd> OuterPoints(const RobotModel& robot) {
  std::vector<Eigen::Matrix3Xd> all;
  for (const RobotBody& body : robot.bodies) {
    std::vector<Eigen::Vector3d> points;
    if (body.shape.disc_radius == 0.0 && body.shape.ball_radius == 0.0) {
      for (int i = 0; i < body.shape.vertices.cols(); ++i) {
        points.emplace_back(body.shape.vertices.col(i));
      }
    }
    for (int k = 0; k < 27; ++k) {
      const Eigen::Vector3d direction(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
      if (k != 13) points.push_back(SupportPoint(body.shape, direction.normalized()));
    }
    Eigen::Matrix3Xd matrix(3, static_cast<Eigen::Index>(points.size()));
    for (size_t i = 0; i < points.size(); ++i) matrix.col(static_cast<Eigen::Index>(i)) = points[i];
    all.push_back(std::move(matrix));
  }
  return all;
}

/// What is bounded over an interval, to compare with what happens.
enum class Bounded {
  kDisplacement,   ///< of a body's points in W [m]
  kDisplacementB,  ///< and as seen from the waist [m]
  kJointAngle,     ///< change [rad]
  kJointRate,      ///< change of joint speed [rad/s]
  kJointSpeed,     ///< [rad/s]
  kTurn,           ///< of a link, seen from the waist or the sole [rad/s]
  kTurnRate,       ///< its change, as a vector there [rad/s]
  kLegLength,      ///< change of the hip-ankle distance [m]
  kValue,          ///< change of a walk quantity [m], [rad]
  kRate,           ///< change of its rate [m/s], [rad/s]
  kSecond,         ///< its second derivative [m/s²], [rad/s²]
};
constexpr size_t kNumBounded = 11;
constexpr std::array<std::string_view, kNumBounded> kBoundedNames = {
    "displacement", "displacement_B", "joint angle", "joint rate", "joint speed", "turn",
    "turn rate",    "leg length",     "value",       "rate",       "second"};

/// The posture at an instant, as the walk's inverse kinematics gives it, or none out of reach.
inline std::optional<Posture> PostureAt(const RobotModel& robot, const WalkJet& jet) {
  Posture posture = SolvePosture(robot, jet.value);
  if (!posture.reachable || !SolveJointSpeeds(robot, jet, &posture)) return std::nullopt;
  return posture;
}

/// Angular velocity of a leg's link: of links 0–2 seen from the waist, of links 3–5 from the sole.
inline Eigen::Vector3d LinkTurn(const Posture& posture, size_t leg, int link) {
  Eigen::Vector3d omega_B(0, 0, 0);
  const auto& axis_B = posture.frames[leg].axis_B;
  const bool from_waist = LegAnchors::OnHip(link);
  for (int j = from_waist ? 0 : link + 1; j < (from_waist ? link + 1 : 6); ++j) {
    omega_B += (from_waist ? 1.0 : -1.0) * posture.speeds[leg][j] * axis_B[static_cast<size_t>(j)];
  }
  if (from_waist) return omega_B;
  return posture.frames[leg].X_BLink[6].linear().transpose() * omega_B;
}

/// Largest distance of a body's points between two postures, in W or as seen from the waist [m].
inline double LargestDisplacement(const RobotBody& body, const Eigen::Matrix3Xd& points,
                                  const Posture& from, const Posture& to, bool seen_from_waist) {
  Eigen::Isometry3d X0 = from.OfBody(body), X1 = to.OfBody(body);
  if (seen_from_waist) {
    X0 = from.X_WB.inverse() * X0;
    X1 = to.X_WB.inverse() * X1;
  }
  return (X1 * points - X0 * points).colwise().norm().maxCoeff();
}

/// Calls visit(kind, index, truth, bound) for everything that `motion` bounds, at an instant of its
/// interval when the quantities are `jet`. False when the legs do not reach then, which contradicts
/// `motion.bounded`.
template <typename Visit>
bool CompareWithTruth(const RobotModel& robot, const std::vector<Eigen::Matrix3Xd>& points,
                      const WalkJet& jet, const IntervalMotion& motion, const Visit& visit) {
  const auto posture = PostureAt(robot, jet);
  if (!posture) return false;
  for (int q = 0; q < kNumQuantities; ++q) {
    visit(Bounded::kValue, q, std::abs(jet.value[q] - motion.jet.value[q]), motion.Change(q));
    visit(Bounded::kRate, q, std::abs(jet.first[q] - motion.jet.first[q]), motion.RateChange(q));
    visit(Bounded::kSecond, q, std::abs(jet.second[q]), motion.second[q]);
  }
  const double h = motion.half_width;
  for (size_t s = 0; s < 2; ++s) {
    for (int j = 0; j < 6; ++j) {
      const int index = 6 * static_cast<int>(s) + j;
      const double speed = std::abs(motion.posture.speeds[s][j]);
      const double acceleration = motion.joints[s].acceleration[j];
      const double turn = std::remainder(posture->ik[s].q[j] - motion.posture.ik[s].q[j],
                                         2 * 3.14159265358979323846);
      visit(Bounded::kJointAngle, index, std::abs(turn), h * (speed + 0.5 * h * acceleration));
      visit(Bounded::kJointRate, index,
            std::abs(posture->speeds[s][j] - motion.posture.speeds[s][j]), h * acceleration);
      visit(Bounded::kJointSpeed, index, std::abs(posture->speeds[s][j]),
            motion.joints[s].speed[j]);
      const TurnBound& bound = motion.joints[s].turns[static_cast<size_t>(j)];
      const Eigen::Vector3d link_turn = LinkTurn(*posture, s, j);
      visit(Bounded::kTurn, index, link_turn.norm(), bound.speed);
      visit(Bounded::kTurnRate, index, (link_turn - LinkTurn(motion.posture, s, j)).norm(),
            h * bound.acceleration);
    }
    visit(Bounded::kLegLength, static_cast<int>(s),
          std::abs(posture->ik[s].reach_margin - motion.posture.ik[s].reach_margin),
          motion.leg_length_change[s]);
  }
  for (size_t b = 0; b < robot.bodies.size(); ++b) {
    const RobotBody& body = robot.bodies[b];
    visit(Bounded::kDisplacement, static_cast<int>(b),
          LargestDisplacement(body, points[b], motion.posture, *posture, false),
          motion.displacement[b]);
    visit(Bounded::kDisplacementB, static_cast<int>(b),
          LargestDisplacement(body, points[b], motion.posture, *posture, true),
          motion.displacement_B[b]);
  }
  return true;
}

/// The same at the instant t of a walk.
template <typename Visit>
bool CompareWithTruth(const RobotModel& robot, const std::vector<Eigen::Matrix3Xd>& points,
                      const SuperposedWalk& walk, const IntervalMotion& motion, double t,
                      const Visit& visit) {
  return CompareWithTruth(robot, points, walk.At(t), motion, visit);
}

}  // namespace halfstep
