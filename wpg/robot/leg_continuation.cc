#include "wpg/robot/leg_continuation.h"

#include <algorithm>
#include <cmath>

#include "wpg/elementary.h"
#include "wpg/robot/leg_ik.h"
#include "wpg/robot/leg_neighbourhood.h"
#include "wpg/robot/placing_rounding.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr int kMostSteps = 64;
constexpr double kStride = 0.08;     // what a step asks of a joint at first [rad]
constexpr double kShortest = 1e-3;   // step, as a part of the offsets
constexpr double kResidual = 3e-14;  // of the pose in the end [rad], [m]
constexpr double kWider = 1e-8;      // than what is known to hold a posture a box is by this [rad]

// Twists about a point of a way between two poses on which the origin goes straight and the body
// turns evenly. They are affine in time, so their mean is that at the middle, and absolute values
// are largest at an end.
class Way {
 public:
  Way(const Isometry3d& from, const Isometry3d& to, const Vector3d& about)
      : shift_(to.translation() - from.translation()), lever_(about - from.translation()) {
    const Eigen::Matrix3d R = to.linear() * from.linear().transpose();
    const Vector3d twice(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
    const double sine = 0.5 * twice.norm(), angle = Atan2(sine, 0.5 * (R.trace() - 1.0));
    turn_ = sine > 1e-9 ? Vector3d(0.5 * angle / sine * twice) : Vector3d(0.5 * twice);
  }
  Vector6d At(double s) const {
    Vector6d twist;
    twist << turn_, shift_ + turn_.cross(lever_ - s * shift_);
    return twist;
  }

 private:
  Vector3d shift_, lever_, turn_;
};

// A posture on the lift at a share of the offsets, or so near to it that it is the only one.
struct Node {
  double share = 0.0;
  Vector6d q;
  LegNeighbourhood near;
  Vector6d back;        // J⁻¹ of the twist from its own pose to the demanded one
  Vector6d asked_back;  // and what that asks
  Vector6d unique;      // within this there is one posture for a pose
};

class Continuer {
 public:
  Continuer(const Leg& leg, const Isometry3d& X, const SoleDrift& drift)
      : leg_(leg), X_(X), drift_(drift), rate_(drift.TwistRate(leg.hip_B, X.translation())) {
    const Vector3d turn(0, 0, drift.yaw_rate), lever = leg.hip_B - X.translation();
    velocity_ << turn, drift.velocity + turn.cross(lever);
    // Of the pose, seen as one whose rotation is one, and of the twist, about hip_B.
    turn_off_ = drift.pose_off.turn + SkewOf(X.linear());
    place_off_ = drift.pose_off.place + turn_off_ * lever.norm();
    velocity_off_ = drift.twist_off.place + drift.twist_off.turn * lever.norm();
  }

  // The node of the whole leg; none where the way there cannot be proved.
  std::optional<Node> Follow(const Vector6d& met) const {
    auto node = Settle(0.0, met, Vector6d::Zero());
    double step = 0.0;
    for (int k = 0; node && k < kMostSteps; ++k) {
      if (node->share == 1.0) return node;
      const double left = 1.0 - node->share;
      if (step == 0.0) step = std::min(Stride(*node), left);
      if (auto next = Step(*node, step < left ? node->share + step : 1.0)) {
        node = next;
        step = 0.0;
      } else {
        step *= 0.5;
        if (step < kShortest) break;
      }
    }
    return std::nullopt;
  }

  // Newton's method with the last node's Jacobian. False: the pose is not met to rounding.
  bool Polish(const Node& node, Vector6d* q) const {
    *q = node.q;
    Vector6d step = node.back;
    double residual = 1.0;
    for (int k = 0; k < 10; ++k) {
      *q += step;
      const Way left(LegForwardKinematics(leg_, *q)[6], X_, leg_.hip_B);
      const Vector6d twist = left.At(0.5);
      const double last = residual;
      residual = twist.norm();
      if (residual < 1e-15 || (residual < kResidual && residual > 0.1 * last)) break;
      step = node.near.inverse() * twist;
    }
    return residual < kResidual && Holds(node, *q, Vector6d::Zero());
  }

  // Whether the angles, with that error, are where one posture has a pose.
  static bool Holds(const Node& node, const Vector6d& q, const Vector6d& off) {
    const Vector6d within = (q - node.q).cwiseAbs() + off;
    return (within.array() + 1e-6 * kWider < node.unique.array()).all();
  }

 private:
  // The posture q with the proof that it is, but for what is `back`, the one on the lift, which is
  // known to be within `off` of it.
  std::optional<Node> Settle(double share, const Vector6d& q, const Vector6d& off) const {
    const auto near = LegNeighbourhood::Around(leg_, q, share);
    if (!near) return std::nullopt;
    Node node{.share = share, .q = q, .near = *near, .back = {}, .asked_back = {}, .unique = {}};
    const Way back(near->X_BSole(), X_, leg_.hip_B);
    node.back = near->inverse() * back.At(0.5);
    node.asked_back = (near->inverse() * back.At(0.0))
                          .cwiseAbs()
                          .cwiseMax((near->inverse() * back.At(1.0)).cwiseAbs());
    node.asked_back += near->WayRounding() + near->AskedAnyWay(turn_off_, place_off_);
    const auto settled = near->Ways(node.asked_back);
    if (!settled) return std::nullopt;
    node.unique = off.cwiseMax(*settled).array() + kWider;
    if (!near->InjectiveWithin(node.unique)) return std::nullopt;
    return node;
  }

  // The next node, a step ahead; none when that cannot be proved.
  std::optional<Node> Step(const Node& node, double to) const {
    const double part = to - node.share;
    const Vector6d asked = node.asked_back + AskedByDrift(node.near);
    const auto ways = node.near.Ways(asked, part);
    if (!ways) return std::nullopt;
    const Vector6d by_share = part * node.near.by_share(), straight = node.back + by_share;
    const Vector6d bent = 0.5 * node.near.Bend(straight);
    return Settle(to, node.q + straight + bent,
                  *ways - asked - by_share.cwiseAbs() + bent.cwiseAbs() + node.near.WayRounding() +
                      node.near.ByShareRounding());
  }

  // The step to try first.
  double Stride(const Node& node) const {
    const double most = node.near.by_share().cwiseAbs().maxCoeff();
    return most > kStride ? kStride / most : 1.0;
  }

  // From the pose at m to that at any t.
  Vector6d AskedByDrift(const LegNeighbourhood& near) const {
    const double h = drift_.half_width;
    if (!(h > 0.0)) return Vector6d::Zero();
    return h * ((near.inverse() * velocity_).cwiseAbs() +
                near.AskedAnyWay(drift_.twist_off.turn, velocity_off_) +
                0.5 * h * near.Asked(drift_.yaw_acceleration, rate_));
  }

  const Leg& leg_;
  const Isometry3d& X_;
  const SoleDrift& drift_;
  double rate_, turn_off_, place_off_, velocity_off_;
  Vector6d velocity_;  // the sole's twist at m
};

}  // namespace

// V = v + ψ̇ẑ×(about − p).
double SoleDrift::TwistRate(const Vector3d& about, const Vector3d& p_BSole) const {
  const double speed = velocity.norm() + twist_off.place + half_width * acceleration;
  const double yaw_most = std::abs(yaw_rate) + twist_off.turn + half_width * yaw_acceleration;
  const double lever = (about - p_BSole).head<2>().norm() + pose_off.place + half_width * speed;
  return acceleration + yaw_acceleration * lever + yaw_most * speed;
}

LegContinuation ContinueLeg(const Leg& leg, const Isometry3d& X_BSole) {
  LegContinuation result;
  const LegIkSolution met = SolveLegIk(leg.met.front(), X_BSole);
  result.missing = std::max(-met.reach_margin, 1e-6);
  if (met.status != LegIkStatus::kSolved) return result;
  const SoleDrift at_rest;
  const Continuer continuer(leg, X_BSole, at_rest);
  const auto node = continuer.Follow(met.q);
  result.arrived = node && continuer.Polish(*node, &result.q);
  if (result.arrived) result.missing = 0.0;
  return result;
}

bool StaysInBranch(const Leg& leg, const Isometry3d& X_BSole, const SoleDrift& drift,
                   const Vector6d& q, const Vector6d& off) {
  const LegIkSolution met = SolveLegIk(leg.met.front(), X_BSole);
  if (met.status != LegIkStatus::kSolved) return false;
  const auto node = Continuer(leg, X_BSole, drift).Follow(met.q);
  return node && Continuer::Holds(*node, q, off);
}

}  // namespace halfstep
