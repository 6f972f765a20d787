#include "wpg/robot/offset_leg_bound.h"

#include <algorithm>
#include <cmath>

#include "wpg/nth.h"
#include "wpg/robot/bootstrap.h"
#include "wpg/robot/leg_neighbourhood.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

// Sups of q̈ given sups of q̇: YJ q̈ = Y(V̇ − J̇q̇), with Y ≈ J⁻¹ at m.
class OffsetJoints {
 public:
  OffsetJoints(const LegNeighbourhood& near, double rate, const SoleDrift& drift,
               const Vector6d& off)
      : near_(near),
        h_(drift.half_width),
        asked_(near.Asked(drift.yaw_acceleration, rate)),
        off_(off) {}

  std::optional<Vector6d> Accelerations(const Vector6d& speeds) const {
    const Vector6d radius = h_ * speeds + off_;
    const Matrix6d change = near_.Change(radius);
    const auto contraction = Contraction::Of(change);
    if (!contraction) return std::nullopt;
    return contraction->Resolve(change, asked_ + near_.Bending(speeds, radius));
  }

 private:
  const LegNeighbourhood& near_;
  double h_;
  Vector6d asked_, off_;
};

// Angular velocity of link `link` at m, seen from the waist (links 0–2) or the sole.
Vector3d LinkTurn(const LegFrames& frames, const Vector6d& speeds, int link) {
  const bool from_waist = LegAnchors::OnHip(link);
  Vector3d turn(0, 0, 0);
  for (int j = from_waist ? 0 : link + 1; j < (from_waist ? link + 1 : 6); ++j) {
    turn += speeds[j] * Nth(frames.axis_B, j);
  }
  return turn;
}

// From the joints' sups. Each joint's axis turns with the links before it, seen from the base.
std::array<TurnBound, 6> Turns(const LegFrames& frames, const Vector6d& at_m,
                               const JointBounds& bounds, double h) {
  std::array<TurnBound, 6> turns;
  const auto fill = [&](int first, int last, int step, int joint) {
    TurnBound so_far;
    for (int link = first; link != last; link += step) {
      const int j = link + joint;
      const double speed = bounds.speed[j];
      so_far.acceleration += bounds.acceleration[j] + so_far.speed * speed;
      so_far.speed += speed;
      Nth(turns, link) = {
          std::min(so_far.speed, LinkTurn(frames, at_m, link).norm() + h * so_far.acceleration),
          so_far.acceleration};
    }
  };
  fill(0, 3, 1, 0);
  fill(4, 2, -1, 1);
  turns[5] = {0.0, 0.0};
  return turns;
}

}  // namespace

std::optional<JointBounds> BoundOffsetJoints(const Leg& leg, const Vector6d& q,
                                             const LegFrames& frames, const Vector6d& speeds,
                                             const SoleDrift& of_sole, const LegRounding& off) {
  const Eigen::Isometry3d& X_BSole = frames.X_BLink[6];
  SoleDrift drift = of_sole;
  drift.pose_off = off.pose;
  drift.twist_off = off.twist;
  const auto near = LegNeighbourhood::Around(leg, q);
  if (!near || !StaysInBranch(leg, X_BSole, drift, q, off.q)) return std::nullopt;
  const double h = drift.half_width;
  const OffsetJoints joints(*near, drift.TwistRate(leg.hip_B, X_BSole.translation()), drift, off.q);
  Vector6d accelerations;
  const auto most =
      Bootstrap<Vector6d>(speeds.cwiseAbs() + off.speeds, h, [&](const Vector6d& assumed) {
        const auto given = joints.Accelerations(assumed);
        if (given) accelerations = *given;
        return given;
      });
  if (!most) return std::nullopt;
  JointBounds bounds{.speed = *most, .acceleration = accelerations, .turns = {}};
  bounds.turns = Turns(frames, speeds, bounds, h);
  for (TurnBound& turn : bounds.turns) turn.speed += off.speeds.sum() + off.turn * most->sum();
  return bounds;
}

double LegLengthChange(const LegLength& length, double turn) {
  const double steepest = std::sqrt(length.product);
  const double nearest = length.distance - turn * steepest;
  if (!(nearest > 0.0)) return turn * steepest;
  return turn * std::min(steepest, std::abs(length.slope) + turn * length.product / nearest);
}

}  // namespace halfstep
