#include "wpg/motion/motion_bounds.h"

#include <algorithm>
#include <cmath>

#include "wpg/check.h"
#include "wpg/elementary.h"
#include "wpg/nth.h"
#include "wpg/robot/offset_leg_bound.h"

namespace halfstep {
namespace {

// Distance of a point of a shape posed at X from the vertical axis of X's base, at most.
double Lever(const Eigen::Vector3d& center, double radius) {
  return center.head<2>().norm() + radius;
}

// Yaw rate of a sole seen from the waist.
double YawRate(const WalkJet& jet, Side side) {
  return jet.first[FootIndex(side) + 3] - jet.first[kWaistYaw];
}

// √(x² + y²) of two quantities' sups.
double Planar(const WalkState& x, int quantity) { return Hypot(x[quantity], x[quantity + 1]); }

// Of three quantities: x, y and `z`.
double InSpace(const WalkState& x, int quantity, int z) {
  return x[z] == 0.0 ? Planar(x, quantity) : Hypot(Planar(x, quantity), x[z]);
}

}  // namespace

MotionBounds::MotionBounds(const RobotModel& robot)
    : robot_(robot),
      anchors_{LegAnchors(robot.legs[0]), LegAnchors(robot.legs[1])},
      rounding_(robot) {
  for (const RobotBody& body : robot.bodies) {
    levers_.push_back(body.leg < 0 ? std::array<double, 6>{}
                                   : Nth(anchors_, body.leg).Levers(body));
  }
}

MotionBounds::BaseRates MotionBounds::SoleRates(const IntervalMotion& motion, Side side) {
  const int i = FootIndex(side);
  const Eigen::Vector3d second = motion.second.segment<3>(i);
  BaseRates rates;
  rates.acceleration = second.norm();
  rates.speed = motion.jet.first.segment<3>(i).norm() + motion.half_width * rates.acceleration +
                motion.off.first.segment<3>(i).sum();
  rates.yaw_acceleration = motion.second[i + 3];
  rates.yaw_rate = std::abs(motion.jet.first[i + 3]) + motion.RateChange(i + 3);
  return rates;
}

MotionBounds::BaseRates MotionBounds::WaistRates(const IntervalMotion& motion) const {
  // p_WB = c − R(yaw)·(com_x, 0).
  BaseRates rates;
  rates.yaw_acceleration = motion.second[kWaistYaw];
  rates.yaw_rate = std::abs(motion.jet.first[kWaistYaw]) + motion.RateChange(kWaistYaw);
  const double arm = std::abs(robot_.com_x_B);
  const double second = InSpace(motion.second, kComX, kWaistZ);
  rates.acceleration = second + arm * Turning(rates);
  rates.speed = InSpace(motion.jet.first, kComX, kWaistZ) + motion.half_width * second +
                arm * rates.yaw_rate + motion.rounding.origin_speed;
  return rates;
}

double MotionBounds::Turning(const BaseRates& base) {
  return base.yaw_acceleration + base.yaw_rate * base.yaw_rate;
}

double MotionBounds::AccelerationFrom(const BaseRates& base, const std::array<TurnBound, 6>& turns,
                                      const std::array<double, 6>& levers, double lever) {
  double turned = 0.0;
  for (size_t i = 0; i < 6; ++i) {
    const auto& [speed, acceleration] = turns[i];
    turned += (2.0 * base.yaw_rate * speed + acceleration + speed * speed) * levers[i];
  }
  return base.acceleration + Turning(base) * lever + turned;
}

MotionBounds::LegRates MotionBounds::RatesOfLeg(const IntervalMotion& motion, Side side,
                                                const BaseRates& waist) {
  const size_t s = static_cast<size_t>(Index(side));
  const Posture& posture = motion.posture;
  LegRates rates;
  rates.sole = SoleRates(motion, side);
  // Seen from the turning waist: d̈ − ψ̈ẑ×d − 2ψ̇ẑ×ḋ + ψ̇²ẑ×(ẑ×d).
  const Eigen::Vector3d lever = posture.X_WSole[s].translation() - posture.X_WB.translation();
  const double speed = rates.sole.speed + waist.speed;
  rates.sole_B.acceleration = rates.sole.acceleration + waist.acceleration +
                              Turning(waist) * (lever.head<2>().norm() + motion.half_width * speed +
                                                motion.rounding.legs[s].points) +
                              2.0 * waist.yaw_rate * speed;
  rates.sole_B.yaw_acceleration = rates.sole.yaw_acceleration + waist.yaw_acceleration;
  rates.sole_B.yaw_rate = std::abs(YawRate(motion.jet, side)) +
                          motion.half_width * rates.sole_B.yaw_acceleration +
                          motion.off.first[FootIndex(side) + 3] + motion.off.first[kWaistYaw];
  Eigen::Vector3d omega{0, 0, 0}, velocity{0, 0, 0};
  for (size_t i = 0; i < 6; ++i) {
    const Eigen::Vector3d turn =
        posture.speeds[s][static_cast<Eigen::Index>(i)] * posture.frames[s].axis_B[i];
    rates.omega_B[i] = omega += turn;
    rates.velocity_B[i] = velocity += posture.frames[s].point_B[i].cross(turn);
  }
  return rates;
}

bool MotionBounds::BoundLeg(Side side, const BaseRates& waist, const LegRates& rates,
                            IntervalMotion* motion) const {
  const size_t s = static_cast<size_t>(Index(side));
  const int foot = FootIndex(side);
  const LegAnchors& anchors = anchors_[s];
  const Posture& posture = motion->posture;
  const WalkState& first = motion->jet.first;
  const double h = motion->half_width;
  const BaseRates& sole = rates.sole;

  // w = hip − ankle, in W.
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d hip_W = posture.X_WB.linear() * anchors.hip_B();
  const Eigen::Vector3d ankle_W = posture.X_WSole[s].linear() * anchors.ankle_S();
  const Eigen::Vector3d w =
      posture.X_WB.translation() + hip_W - posture.X_WSole[s].translation() - ankle_W;
  const Eigen::Vector3d w_rate = posture.waist_velocity + first[kWaistYaw] * z.cross(hip_W) -
                                 first.segment<3>(foot) - first[foot + 3] * z.cross(ankle_W);
  const double hip_lever = Hypot(anchors.hip_B().x() - robot_.com_x_B, anchors.hip_B().y());
  const double ankle_lever = anchors.ankle_S().head<2>().norm();
  Eigen::Vector3d second = motion->second.segment<3>(foot);
  second.head<2>() +=
      motion->second.segment<2>(kComX) +
      Eigen::Vector2d::Constant(Turning(waist) * hip_lever + Turning(sole) * ankle_lever);
  second.z() += motion->second[kWaistZ];
  const LegRounding& off = motion->rounding.legs[s];
  const Eigen::Vector3d moves = w_rate.cwiseAbs().array() + off.point_speeds;
  const Eigen::Vector3d rate = moves + h * second;
  const Eigen::Vector3d most = (w.cwiseAbs() + h * (moves + 0.5 * h * second)).array() + off.points;
  const LegDemand demand{.half_square = rate.squaredNorm() + most.dot(second),
                         // Seen from the turning sole, in the same way.
                         .horizontal = second.head<2>().norm() +
                                       Turning(sole) * most.head<2>().norm() +
                                       2.0 * sole.yaw_rate * rate.head<2>().norm(),
                         .vertical = second.z(),
                         .yaw_rate = rates.sole_B.yaw_rate,
                         .yaw_acceleration = rates.sole_B.yaw_acceleration};
  const auto bounds = BoundJoints(anchors, posture.frames[s], posture.speeds[s],
                                  YawRate(motion->jet, side), demand, h, off);
  if (!bounds) return false;
  motion->joints[s] = *bounds;
  const double change = 2.0 * h *
                        (std::abs(w.dot(w_rate)) + off.points * w_rate.norm() +
                         off.point_speeds * w.norm() + 0.5 * h * demand.half_square);
  const double nearest2 = std::max(0.0, w.squaredNorm() - change);
  motion->leg_length_change[s] = change / (w.norm() + std::sqrt(nearest2)) + off.reach;
  return true;
}

bool MotionBounds::BoundOffsetLeg(Side side, const LegRates& rates, IntervalMotion* motion) const {
  const size_t s = static_cast<size_t>(Index(side));
  const Posture& posture = motion->posture;
  const Eigen::Vector3d sole = posture.frames[s].X_BLink[6].translation();
  const BaseRates& rates_B = rates.sole_B;
  const SoleDrift drift{.half_width = motion->half_width,
                        .velocity = rates.velocity_B[5] + rates.omega_B[5].cross(sole),
                        .yaw_rate = YawRate(motion->jet, side),
                        .acceleration = rates_B.acceleration,
                        .yaw_acceleration = rates_B.yaw_acceleration};
  const auto bounds = BoundOffsetJoints(robot_.legs[s], posture.ik[s].q, posture.frames[s],
                                        posture.speeds[s], drift, motion->rounding.legs[s]);
  if (!bounds) return false;
  motion->joints[s] = *bounds;
  const LegRounding& off = motion->rounding.legs[s];
  motion->leg_length_change[s] = LegLengthChange(LegLengthAt(robot_.legs[s], posture.ik[s].q[3]),
                                                 motion->half_width * bounds->speed[3] + off.q[3]) +
                                 off.reach;
  return true;
}

void MotionBounds::BoundBody(size_t index, const BaseRates& waist,
                             const std::array<LegRates, 2>& legs, IntervalMotion* motion) const {
  const RobotBody& body = robot_.bodies[index];
  const Posture& posture = motion->posture;
  const double h = motion->half_width;
  const double radius = body.shape.radius;

  // Velocity at m of the body's sphere, exact, seen from the waist; and sups of accelerations.
  Eigen::Vector3d center_B = body.shape.center, velocity_B{0, 0, 0}, omega_B{0, 0, 0};
  double world = 0.0, from_waist = 0.0;
  if (body.leg < 0) {
    world = AccelerationFrom(waist, {}, {}, Lever(center_B, radius));
  } else {
    const size_t s = static_cast<size_t>(body.leg), link = static_cast<size_t>(body.link);
    const LegRates& leg = legs[s];
    center_B = posture.frames[s].X_BLink[link] * body.shape.center;
    omega_B = leg.omega_B[link];
    velocity_B = leg.velocity_B[link] + omega_B.cross(center_B);
    const auto& turns = motion->joints[s].turns;
    const auto& levers = levers_[index];
    double moved = 0.0;
    for (size_t i = 0; i < 6; ++i) moved += h * turns[i].speed * levers[i];
    if (LegAnchors::OnHip(body.link)) {
      from_waist = AccelerationFrom({}, turns, levers, 0.0);
      world = AccelerationFrom(waist, turns, levers, Lever(center_B, radius) + moved);
    } else {
      const Eigen::Vector3d from_sole = center_B - posture.frames[s].X_BLink[6].translation();
      const double lever = Lever(from_sole, radius) + moved;
      from_waist = AccelerationFrom(leg.sole_B, turns, levers, lever);
      world = AccelerationFrom(leg.sole, turns, levers, lever);
    }
  }

  const Eigen::Matrix3d& R = posture.X_WB.linear();
  const Eigen::Vector3d omega_W =
      R * omega_B + motion->jet.first[kWaistYaw] * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d velocity_W =
      posture.waist_velocity + R * velocity_B +
      motion->jet.first[kWaistYaw] * Eigen::Vector3d::UnitZ().cross(R * center_B);
  const double speed_W = velocity_W.norm() + omega_W.norm() * radius;
  const double speed_B = velocity_B.norm() + omega_B.norm() * radius;
  const PostureRounding& off = motion->rounding;
  const LegRounding* leg_off = body.leg < 0 ? nullptr : &Nth(off.legs, body.leg);
  const double place_off = leg_off ? leg_off->points : off.waist;
  const double speed_off = leg_off ? leg_off->point_speeds : off.waist_speed;
  motion->displacement[index] = h * (speed_W + speed_off + 0.5 * h * world) + place_off;
  motion->displacement_B[index] = h * (speed_B + speed_off + 0.5 * h * from_waist) + place_off;
}

void MotionBounds::Bound(const WalkJet& mid, const WalkState& second, double half_width,
                         IntervalMotion* motion, const WalkJet* rounding) const {
  HALFSTEP_CHECK(half_width >= 0.0, "half_width = " << half_width);
  motion->half_width = half_width;
  motion->jet = mid;
  motion->off = rounding == nullptr ? WalkJet() : *rounding;
  // Of what is sampled at the interval's ends, which are rounded too.
  motion->second = second + motion->off.second;
  motion->displacement.resize(robot_.bodies.size());
  motion->displacement_B.resize(robot_.bodies.size());
  motion->posture = SolvePosture(robot_, motion->jet.value);
  motion->bounded = motion->posture.reachable;
  if (!motion->bounded) return;
  motion->bounded = SolveJointSpeeds(robot_, motion->jet, &motion->posture);
  if (!motion->bounded) return;
  motion->rounding =
      rounding == nullptr ? PostureRounding() : rounding_.At(mid, motion->off, motion->posture);
  const BaseRates waist = WaistRates(*motion);
  std::array<LegRates, 2> legs;
  for (Side side : {Side::kLeft, Side::kRight}) {
    LegRates& leg = Nth(legs, Index(side));
    leg = RatesOfLeg(*motion, side, waist);
    motion->bounded = Nth(robot_.legs, Index(side)).closed_form()
                          ? BoundLeg(side, waist, leg, motion)
                          : BoundOffsetLeg(side, leg, motion);
    if (!motion->bounded) return;
  }
  for (size_t b = 0; b < robot_.bodies.size(); ++b) BoundBody(b, waist, legs, motion);
}

}  // namespace halfstep
