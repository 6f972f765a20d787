#include "wpg/motion/posture_rounding.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "wpg/nth.h"
#include "wpg/rounded.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

constexpr double kU = kRoundoff;

double Sum(const Vector3d& x) { return x.cwiseAbs().sum(); }

// How far the rotation and the origin of a leg's last frame may be from those of the exact leg at
// these angles: PlaceLeg turns about axes that it has turned.
struct Placing {
  double turn = 0.0, place = 0.0;
};

Placing PlacingOf(const Vector6d& q, double chain) {
  // R(1 + S) in place of R: a joint turns the antisymmetric part of S along, and makes the rest up
  // to 1 + |sin q| + 2(1 − cos q) times as large.
  double rest = 0.0;
  Placing placing;
  for (int j = 0; j < 6; ++j) {
    const double angle = std::abs(q[j]), more = std::min(angle + angle * angle, 4.3);
    const double own = (24.0 + 40.0 * std::min(angle, 1.3)) * kU;
    placing.turn += more * rest + own;
    rest = (1.0 + more) * rest + own;
  }
  placing.place = placing.turn * chain + 100.0 * kU * chain;
  return placing;
}

// Norms of the two halves of a matrix's rows.
struct Rows {
  explicit Rows(const Matrix6d& Y)
      : angular(Y.leftCols<3>().rowwise().norm()), linear(Y.rightCols<3>().rowwise().norm()) {}
  Vector6d Of(double turn, double place) const { return turn * angular + place * linear; }
  Vector6d angular, linear;
};

}  // namespace

Vector6d ResolvedRounding(const Vector6d& at, const Vector6d& k) {
  const double share = k.maxCoeff();
  if (!(share < 0.5)) return Vector6d::Constant(std::numeric_limits<double>::infinity());
  return at + k * (at.maxCoeff() / (1.0 - share));
}

RoundingOfPostures::RoundingOfPostures(const RobotModel& robot)
    : robot_(robot), waist_(robot.masses.waist.com.norm()) {
  for (size_t s = 0; s < 2; ++s) {
    const Leg& leg = robot.legs[s];
    Vector3d at = Vector3d::Zero();
    double chain = 0.0, link = 0.0, body_size = 0.0;
    for (const LegJoint& joint : leg.joints) {
      chain += (joint.point_B - at).norm();
      at = joint.point_B;
      link = std::max(link, (joint.X_BLink.translation() - at).norm());
    }
    chain += (leg.X_BSole.translation() - at).norm();
    for (const BodyMass& mass : robot.masses.links[s]) {
      body_size = std::max(body_size, mass.com.norm());
    }
    for (const RobotBody& body : robot.bodies) {
      const double size = body.shape.center.norm() + body.shape.radius;
      if (body.leg == static_cast<int>(s)) body_size = std::max(body_size, size);
      if (body.leg < 0) waist_ = std::max(waist_, size);
    }
    legs_[s] = {chain, chain + link + body_size};
  }
}

RoundingOfPostures::Upright RoundingOfPostures::WaistOf(const RobotModel& robot, const WalkJet& jet,
                                                        const WalkJet& walk) {
  const WalkState &x = jet.value, &v = jet.first;
  const double arm = std::abs(robot.com_x_B), turn = walk.value[kWaistYaw] + 8.0 * kU;
  Upright waist{.place = walk.value[kComX] + walk.value[kComY] + walk.value[kWaistZ] + arm * turn,
                .speed = walk.first[kComX] + walk.first[kComY] + walk.first[kWaistZ],
                .turn = turn,
                .rate = walk.first[kWaistYaw]};
  waist.place += 4.0 * kU *
                 (std::abs(x[kComX]) + std::abs(x[kComY]) + 2.0 * arm +
                  std::abs(robot.waist_height) + std::abs(x[kWaistZ]));
  waist.speed += arm * (waist.rate + (turn + 4.0 * kU) * std::abs(v[kWaistYaw])) +
                 2.0 * kU * (std::abs(v[kComX]) + std::abs(v[kComY]));
  return waist;
}

LegRounding RoundingOfPostures::OfLeg(Side side, const WalkJet& jet, const WalkJet& walk,
                                      const Upright& waist, const Posture& posture) const {
  const size_t s = static_cast<size_t>(Index(side));
  const auto& [chain, farthest] = legs_[s];
  const int foot = FootIndex(side);
  const LegFrames& frames = posture.frames[s];
  const Vector6d& q = posture.ik[s].q;
  const Eigen::Matrix3d R_BW = posture.X_WB.linear().transpose();
  const Vector3d lever_W = posture.X_WSole[s].translation() - posture.X_WB.translation();
  const double lever = lever_W.norm();
  const double far = Sum(posture.X_WB.translation()) + Sum(posture.X_WSole[s].translation());

  // Pose of the sole in B: that of the computed angles, and the demanded one.
  const Eigen::Matrix3d R = R_BW * posture.X_WSole[s].linear();
  const Eigen::Isometry3d& placed = frames.X_BLink[6];
  const Placing placing = PlacingOf(q, chain);
  const double sole = walk.value.segment<3>(foot).sum(), sole_turn = walk.value[foot + 3];
  const double demanded = waist.place + sole + waist.turn * lever + 12.0 * kU * lever;
  const double place = (placed.translation() - R_BW * lever_W).norm() + placing.place + demanded;
  const double turn =
      0.75 * (placed.linear() - R).norm() + 1.5 * placing.turn + waist.turn + sole_turn + 24.0 * kU;

  // |x| ≤ |Y|·asked + (|1 − YJ| + |Y|·|J's error|)·|x|, J's error growing with |x|.
  const Matrix6d &Y = posture.jacobian_inverse[s], J = LegJacobian(frames);
  const Rows rows(Y);
  const double of_axes = placing.turn + 4.0 * kU,
               of_points = 3.0 * placing.place + 8.0 * kU * chain;
  const Vector6d left = (Matrix6d::Identity() - Y * J).cwiseAbs().rowwise().sum() +
                        64.0 * kU * (Y.cwiseAbs() * J.cwiseAbs()).rowwise().sum() +
                        6.0 * rows.Of(of_axes, of_points);
  const Vector6d asked = rows.Of(turn, place), bent = rows.Of(1.0, 2.0 * chain);
  const double share = left.maxCoeff(), y = asked.maxCoeff();
  // Twice what the linear part lets the angles be off: a path from the computed angles to the exact
  // ones cannot leave that where it is resolved.
  const double most = share < 0.5 ? 4.0 * y : std::numeric_limits<double>::infinity();
  LegRounding rounding;
  rounding.q = ResolvedRounding(asked, left + 36.0 * most * bent);

  // Distance of hip and ankle: from the pose, or from the knee's angle.
  rounding.reach = robot_.legs[s].closed_form()
                       ? demanded + 16.0 * kU * far + (waist.turn + sole_turn) * chain
                       : chain * rounding.q[3];
  rounding.reach += 40.0 * kU * chain;

  const double turned = rounding.turn = rounding.q.sum() + placing.turn;
  rounding.points = waist.place + waist.turn * farthest + turned * farthest + placing.place +
                    12.0 * kU * (far + farthest);

  // Speeds: the twist that the computed ones miss, and what may be missing in that.
  const WalkState& v = jet.first;
  const double rate = std::abs(v[kWaistYaw]);
  Vector6d twist;
  twist << 0.0, 0.0, v[foot + 3] - v[kWaistYaw],
      R_BW * (v.segment<3>(foot) - posture.waist_velocity -
              v[kWaistYaw] * Vector3d::UnitZ().cross(lever_W));
  const Vector6d& speeds = posture.speeds[s];
  const Vector6d missing = twist - J * speeds;
  const double all = speeds.cwiseAbs().sum();
  const double parts = v.segment<3>(foot).norm() + posture.waist_velocity.norm() + rate * lever;
  const double axes = turned + 4.0 * kU, points = 3.0 * (chain * turned + placing.place);
  const double twist_turn = missing.head<3>().norm() + waist.rate + walk.first[foot + 3] +
                            axes * all + 16.0 * kU * (all + rate + std::abs(v[foot + 3]));
  const double twist_speed = missing.tail<3>().norm() + waist.speed +
                             walk.first.segment<3>(foot).sum() + lever * waist.rate +
                             rate * (waist.place + sole) + waist.turn * parts + points * all +
                             24.0 * kU * (parts + chain * all);
  rounding.chain = chain;
  rounding.of_inverse = left + 6.0 * rows.Of(axes, points);
  rounding.speeds = ResolvedRounding(rows.Of(twist_turn, twist_speed), rounding.of_inverse);
  rounding.point_speeds =
      waist.speed +
      farthest * (waist.rate + rounding.speeds.sum() + (all + rate) * (2.0 * turned + waist.turn)) +
      32.0 * kU * (parts + farthest * (all + rate));
  return rounding;
}

PostureRounding RoundingOfPostures::At(const WalkJet& jet, const WalkJet& walk,
                                       const Posture& posture) const {
  const Upright waist = WaistOf(robot_, jet, walk);
  PostureRounding rounding;
  rounding.waist =
      waist.place + waist.turn * waist_ + 12.0 * kU * (Sum(posture.X_WB.translation()) + waist_);
  rounding.waist_speed =
      waist.speed + waist_ * (waist.rate + waist.turn * std::abs(jet.first[kWaistYaw]));
  for (const Side side : {Side::kLeft, Side::kRight}) {
    Nth(rounding.legs, Index(side)) = OfLeg(side, jet, walk, waist, posture);
  }
  return rounding;
}

}  // namespace halfstep
