#include "smoothing/margins/tube_levers.h"

#include <algorithm>

#include "wpg/nth.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

// Sums and products of some ten numbers are rounded by less.
constexpr double kOutward = 1.0 + 1e-14;

// Points of the axes of the joints between two bodies, in their order, in B at q = 0. Each is
// fixed to the same link as the next one.
using Chain = std::vector<Vector3d>;

// Those of the joints that carry a body, from its own to the hip.
Chain ToWaist(const RobotModel& robot, const RobotBody& body) {
  Chain chain;
  for (int j = body.link; j >= 0; --j) {
    chain.push_back(Nth(robot.legs, body.leg).AxisPoint(static_cast<size_t>(j)));
  }
  return chain;
}

// Those between a link of a leg (−1: the waist) and its sole, to the ankle.
Chain ToSole(const Leg& leg, int link) {
  Chain chain;
  for (int j = link + 1; j < 6; ++j) chain.push_back(leg.AxisPoint(static_cast<size_t>(j)));
  return chain;
}

// Those between two bodies.
Chain Between(const RobotModel& robot, const RobotBody& a, const RobotBody& b) {
  Chain chain = ToWaist(robot, a), other = ToWaist(robot, b);
  if (a.leg == b.leg) {  // the joints that carry both are not between them
    while (!chain.empty() && !other.empty()) {
      chain.pop_back();
      other.pop_back();
    }
  }
  chain.insert(chain.end(), other.rbegin(), other.rend());
  return chain;
}

// The distance of a body's farthest point from a point in B, at q = 0.
double FarthestFrom(const RobotModel& robot, const RobotBody& body, const Vector3d& point_B) {
  const Eigen::Isometry3d X_BBody = body.leg < 0
                                        ? Eigen::Isometry3d::Identity()
                                        : Nth(Nth(robot.legs, body.leg).joints, body.link).X_BLink;
  const Vector3d point = X_BBody.inverse() * point_B;
  double farthest = 0.0;
  for (Eigen::Index v = 0; v < body.shape.vertices.cols(); ++v) {
    farthest = std::max(farthest, (body.shape.vertices.col(v) - point).norm());
  }
  return farthest + body.shape.disc_radius + body.shape.ball_radius;
}

// Bounds of the distances of a body's points from each point of a chain that begins at the body,
// in every posture.
std::vector<double> LeversAlong(const RobotModel& robot, const RobotBody& body,
                                const Chain& chain) {
  std::vector<double> levers;
  for (size_t i = 0; i < chain.size(); ++i) {
    levers.push_back(i == 0 ? FarthestFrom(robot, body, chain[0])
                            : levers.back() + (chain[i] - chain[i - 1]).norm());
  }
  return levers;
}

// The joints between two bodies, each of which turns one of the two past the other.
double LeversBetween(const RobotModel& robot, const RobotBody& a, const RobotBody& b) {
  Chain chain = Between(robot, a, b);
  const std::vector<double> from_a = LeversAlong(robot, a, chain);
  std::ranges::reverse(chain);
  const std::vector<double> from_b = LeversAlong(robot, b, chain);
  double sum = 0.0;
  for (size_t i = 0; i < chain.size(); ++i) {
    sum += std::min(from_a[i], from_b[chain.size() - 1 - i]);
  }
  return sum;
}

}  // namespace

TubeLevers::TubeLevers(const RobotModel& robot) {
  const auto lever = [&robot](const RobotBody& body, Chain chain, const Vector3d& end) {
    chain.push_back(end);
    const std::vector<double> levers = LeversAlong(robot, body, chain);
    Lever sum{.joints = 0.0, .end = levers.back()};
    for (size_t i = 0; i + 1 < levers.size(); ++i) sum.joints += levers[i];
    return sum;
  };
  for (const RobotBody& body : robot.bodies) {
    Body made{.waist = lever(body, ToWaist(robot, body), Vector3d::Zero()), .soles = {}};
    for (int side = 0; side < 2; ++side) {
      if (body.leg >= 0 && body.leg != side) continue;
      const Leg& leg = Nth(robot.legs, side);
      made.soles.push_back(lever(body, ToSole(leg, body.link), leg.X_BSole.translation()));
    }
    bodies_.push_back(std::move(made));
  }
  for (const auto& [a, b] : robot.self_pairs) {
    pairs_.push_back({.a = static_cast<size_t>(a),
                      .b = static_cast<size_t>(b),
                      .joints = LeversBetween(robot, Nth(robot.bodies, a), Nth(robot.bodies, b))});
  }
}

double TubeLevers::WayOf(size_t body, const Tube& tube) const {
  const Body& of = bodies_[body];
  double way = tube.waist + tube.waist_turn * of.waist.end + tube.joint * of.waist.joints;
  for (const Lever& sole : of.soles) {
    way = std::min(way, tube.foot + tube.foot_turn * sole.end + tube.joint * sole.joints);
  }
  return kOutward * way;
}

double TubeLevers::NearerBy(size_t pair, const Tube& tube) const {
  const Pair& of = pairs_[pair];
  return std::min(kOutward * tube.joint * of.joints, WayOf(of.a, tube) + WayOf(of.b, tube));
}

}  // namespace halfstep
