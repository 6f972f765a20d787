#include "wpg/motion/posture_rounding.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "wpg/motion/spatial.h"
#include "wpg/robot/placing_rounding.h"
#include "wpg/rounded.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

constexpr double kU = kRoundoff;

double Sum(const Vector3d& x) { return x.cwiseAbs().sum(); }

// How far axes' directions and points of a leg may be from those of the exact leg at these angles.
struct Placing {
  double turn = 0.0, place = 0.0;
};

Placing PlacingOf(const LegFrames& frames, const Vector6d& q, double chain, double skew_of_links) {
  PlacingRounding rounding;
  rounding.TurnedFirst(q[0]);
  for (size_t j = 1; j < 6; ++j) {
    rounding.Turned(q[static_cast<Eigen::Index>(j)],
                    SkewOf(frames.X_BLink[j].linear()) + skew_of_links);
  }
  return {rounding.turn(), rounding.turn() * chain + 100.0 * kU * chain};
}

// Norms of the two halves of a matrix's rows.
struct Rows {
  explicit Rows(const Matrix6d& Y)
      : angular(Y.leftCols<3>().rowwise().norm()), linear(Y.rightCols<3>().rowwise().norm()) {}
  Vector6d Of(double turn, double place) const { return turn * angular + place * linear; }
  Vector6d Of(const LegRounding::OfSole& off) const { return Of(off.turn, off.place); }
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
    double chain = 0.0, link = 0.0, body_size = 0.0, skew = 0.0;
    for (const LegJoint& joint : leg.joints) {
      chain += (joint.point_B - at).norm();
      at = joint.point_B;
      link = std::max(link, (joint.X_BLink.translation() - at).norm());
      skew = std::max(skew, SkewOf(joint.X_BLink.linear()));
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
    legs_[s] = {chain, chain + link + body_size, skew};
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
  const auto& [chain, farthest, skew] = legs_[s];
  const int foot = FootIndex(side);
  const LegFrames& frames = posture.frames[s];
  const Vector6d& q = posture.ik[s].q;
  const Eigen::Matrix3d R_BW = posture.X_WB.linear().transpose();
  const Vector3d lever_W = posture.X_WSole[s].translation() - posture.X_WB.translation();
  const double lever = lever_W.norm();
  const double far = Sum(posture.X_WB.translation()) + Sum(posture.X_WSole[s].translation());

  // Pose of the sole: that of the computed angles, and the demanded one.
  const Eigen::Isometry3d& placed = frames.X_BLink[6];
  const Placing placing = PlacingOf(frames, q, chain, skew);
  const double sole = walk.value.segment<3>(foot).sum(), sole_turn = walk.value[foot + 3];
  const double demanded = waist.place + sole + waist.turn * lever + 12.0 * kU * lever;
  const double place = (placed.translation() - R_BW * lever_W).norm() + placing.place + demanded;
  const double turn = 0.75 * (posture.X_WLink[s][6].linear() - posture.X_WSole[s].linear()).norm() +
                      1.5 * placing.turn + waist.turn + sole_turn + 24.0 * kU;

  // |x| ≤ |Y|·asked + (|1 − YJ| + |Y|·|J's error|)·|x|, J's error growing with |x|; of the
  // product's own rounding, 64u of the norms of six columns.
  const Matrix6d& Y = posture.jacobian_inverse[s];
  const Vector6d& speeds = posture.speeds[s];
  const Rows rows(Y);
  std::array<Vector3d, 6> moments;  // of J's columns, below the axes
  Vector6d left = Vector6d::Zero();
  for (size_t l = 0; l < 6; ++l) {
    const Vector3d& axis = frames.axis_B[l];
    moments[l] = axis.cross(placed.translation() - frames.point_B[l]);
    Vector6d column = Y * Spatial(axis, moments[l]);
    column[static_cast<Eigen::Index>(l)] -= 1.0;
    left += column.cwiseAbs();
  }
  const double of_axes = placing.turn + 4.0 * kU,
               of_points = 3.0 * placing.place + 8.0 * kU * chain;
  left += 6.0 * rows.Of(of_axes + 64.0 * kU, of_points + 64.0 * kU * chain);
  LegRounding rounding;
  rounding.pose = {.turn = turn, .place = place};
  rounding.placed_turn = of_axes;
  rounding.placed = placing.place;
  const Vector6d asked = rows.Of(rounding.pose), bent = rows.Of(1.0, 2.0 * chain);
  const double share = left.maxCoeff(), y = asked.maxCoeff();
  // Twice what the linear part lets the angles be off: a path from the computed angles to the exact
  // ones cannot leave that where it is resolved.
  const double most = share < 0.5 ? 4.0 * y : std::numeric_limits<double>::infinity();
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
  const Vector6d twist = Spatial({0.0, 0.0, v[foot + 3] - v[kWaistYaw]},
                                 R_BW * (v.segment<3>(foot) - posture.waist_velocity -
                                         v[kWaistYaw] * Vector3d::UnitZ().cross(lever_W)));
  // V₆ − V_l about the sole, and a bound of H δq by its parts.
  Vector3d turned_on = speeds[5] * frames.axis_B[5], moved_on = speeds[5] * moments[5];
  Vector3d bent_turns{0, 0, 0}, bent_places{0, 0, 0};
  for (size_t l = 5; l-- > 0;) {
    const Eigen::Index i = static_cast<Eigen::Index>(l);
    const Vector3d &axis = frames.axis_B[l], &moment = moments[l];
    bent_turns += rounding.q[i] * axis.cross(turned_on).cwiseAbs();
    bent_places += rounding.q[i] * (axis.cross(moved_on) + moment.cross(turned_on)).cwiseAbs();
    turned_on += speeds[i] * axis;
    moved_on += speeds[i] * moment;
  }
  const Vector6d missing = twist - Spatial(turned_on, moved_on);
  const double all = speeds.cwiseAbs().sum();
  const double parts = v.segment<3>(foot).norm() + posture.waist_velocity.norm() + rate * lever;
  // What the angles' errors do to the columns of J: at most five that each joint turns, by brackets
  // of screws to first order; and all beyond.
  const double bent_turn = 5.0 * rounding.q.sum();
  const double beyond = 32.0 * turned * (turned + 64.0 * kU);
  rounding.of_inverse = left + rows.Of(bent_turn + beyond, chain * (2.0 * bent_turn + beyond));
  LegRounding::OfSole& of_twist = rounding.twist;
  of_twist.turn = missing.head<3>().norm() + waist.rate + walk.first[foot + 3] + of_axes * all +
                  16.0 * kU * (all + rate + std::abs(v[foot + 3])) + beyond * all;
  of_twist.place = missing.tail<3>().norm() + waist.speed + walk.first.segment<3>(foot).sum() +
                   lever * waist.rate + rate * (waist.place + sole) +
                   std::abs(v[foot + 3] - v[kWaistYaw]) * place + waist.turn * parts +
                   of_points * all + 24.0 * kU * (parts + chain * all) + chain * beyond * all;
  rounding.chain = chain;
  rounding.speeds = ResolvedRounding(
      rows.Of(of_twist) + Y.cwiseAbs() * Spatial(bent_turns, bent_places), rounding.of_inverse);
  rounding.point_speeds =
      waist.speed +
      farthest * (waist.rate + rounding.speeds.sum() + (all + rate) * (2.0 * turned + waist.turn)) +
      32.0 * kU * (parts + farthest * (all + rate));
  return rounding;
}

PostureRounding RoundingOfPostures::At(const WalkJet& jet, const WalkJet& walk,
                                       const Posture& posture) const {
  const Upright waist = WaistOf(robot_, jet, walk);
  return {.origin = waist.place,
          .origin_speed = waist.speed,
          .waist = waist.place + waist.turn * waist_ +
                   12.0 * kU * (Sum(posture.X_WB.translation()) + waist_),
          .waist_speed =
              waist.speed + waist_ * (waist.rate + waist.turn * std::abs(jet.first[kWaistYaw])),
          .legs = {OfLeg(Side::kLeft, jet, walk, waist, posture),
                   OfLeg(Side::kRight, jet, walk, waist, posture)}};
}

}  // namespace halfstep
