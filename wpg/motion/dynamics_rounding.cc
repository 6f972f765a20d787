#include "wpg/motion/dynamics_rounding.h"

#include <algorithm>
#include <cmath>

#include "wpg/motion/acceleration_rounding.h"
#include "wpg/nth.h"
#include "wpg/rounded.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

// |fl(ab) − xy| where a is off from x by δa, b from y by δb, but for the product's own rounding.
double Product(double a, double off_a, double b, double off_b) {
  return off_a * b + (a + off_a) * off_b;
}

// The sizes of the halves of a twist and of an acceleration.
struct BodySizes {
  explicit BodySizes(const RobotDynamics::Body& body)
      : spin(body.velocity.head<3>().norm()),
        velocity(body.velocity.tail<3>().norm()),
        spin1(body.acceleration.head<3>().norm()),
        acceleration(body.acceleration.tail<3>().norm()) {}
  double spin, velocity, spin1, acceleration;
};

// I a + v ×* I v as ForceOf computes it: products of at most six factors and sums of at most nine.
void AddArithmetic(const RobotDynamics::Body& body, BodyRounding* off) {
  const BodySizes at(body);
  const SpatialInertia& inertia = body.inertia;
  const double arm = inertia.com.norm(), norm = inertia.about_com.norm();
  const double speed = at.velocity + at.spin * arm;
  const double force = inertia.mass * (at.acceleration + at.spin1 * arm + at.spin * speed);
  off->force = 64.0 * kRoundoff * force;
  off->moment =
      64.0 * kRoundoff *
      (arm * force + inertia.mass * at.velocity * speed + norm * (at.spin1 + at.spin * at.spin));
}

BodyRounding OfWaist(const RobotModel& robot, const IntervalMotion& motion,
                     const RobotDynamics& at_m) {
  const WalkJet &jet = motion.jet, &off = motion.off;
  const BodySizes at(at_m.waist());
  const double height = std::abs(motion.posture.X_WB.translation().z());
  const double speed = motion.posture.waist_velocity.norm(),
               speed_off = motion.rounding.waist_speed;
  const double rate = std::abs(jet.first[kWaistYaw]), rate1 = std::abs(jet.second[kWaistYaw]);
  const double arm = std::abs(robot.com_x_B);
  BodyRounding waist{.turn = WaistTurnRounding(motion),
                     .place = motion.rounding.waist,
                     .spin = off.first[kWaistYaw],
                     .spin1 = off.second[kWaistYaw]};
  const double place = Product(rate, waist.spin, height, waist.place);
  waist.velocity = speed_off + place + 16.0 * kRoundoff * (speed + rate * height);
  const double turning = rate1 + rate * rate;
  const double turning_off = waist.spin1 + Product(rate, waist.spin, rate, waist.spin);
  const double of_origin =
      off.second[kComX] + off.second[kComY] + off.second[kWaistZ] +
      arm * (turning_off + (waist.turn + 8.0 * kRoundoff) * (turning + turning_off));
  waist.acceleration =
      of_origin + Product(rate1, waist.spin1, height, waist.place) +
      Product(rate, waist.spin, speed, speed_off) +
      32.0 * kRoundoff * (at.acceleration + arm * turning + rate1 * height + rate * speed);
  return waist;
}

// As RobotDynamics goes along a leg. All points of it are no farther from O than `far`.
void FollowLeg(Side side, const IntervalMotion& motion, const RobotDynamics& at_m,
               const BodyRounding& waist, double far, const Vector6d& accelerations_off,
               std::array<BodyRounding, 6>* links) {
  const LegRounding& leg = Nth(motion.rounding.legs, Index(side));
  const Vector6d& speeds = Nth(motion.posture.speeds, Index(side));
  const double turn = LegTurnRounding(motion, side), place = leg.points + 8.0 * kRoundoff * far;
  const double lever = place + far * turn;  // of a point × an axis
  const RobotDynamics::Body* parent = &at_m.waist();
  BodyRounding link = waist;
  double added = 0.0;  // what q̈ adds, all joints together
  for (size_t j = 0; j < 6; ++j) {
    const Eigen::Index i = static_cast<Eigen::Index>(j);
    const BodySizes at(*parent);
    const double q1 = std::abs(speeds[i]), q2 = std::abs(at_m.accelerations(side)[i]);
    const double off1 = leg.speeds[i], off2 = accelerations_off[i];
    // Of the joint's twist q̇ S and of q̈ S.
    const double w = Product(q1, off1, 1.0, turn), v = Product(q1, off1, far, lever);
    added += q2 * (1.0 + far);
    link.spin1 += Product(q2, off2, 1.0, turn) + Product(at.spin, link.spin, q1, w) +
                  64.0 * kRoundoff * (added + at.spin1 + at.spin * q1);
    link.acceleration +=
        Product(q2, off2, far, lever) + Product(at.spin, link.spin, far * q1, v) +
        Product(at.velocity, link.velocity, q1, w) +
        64.0 * kRoundoff * (added + at.acceleration + at.spin * far * q1 + at.velocity * q1);
    link.spin += w + 16.0 * kRoundoff * (at.spin + q1);
    link.velocity += v + 16.0 * kRoundoff * (at.velocity + far * q1);
    link.turn = turn;
    link.place = place;
    parent = &at_m.leg(side)[j];
    (*links)[j] = link;
    AddArithmetic(*parent, &(*links)[j]);
  }
}

bool IsFinite(const BodyRounding& off) {
  return std::isfinite(off.turn + off.place + off.spin + off.velocity + off.spin1 +
                       off.acceleration + off.moment + off.force);
}

}  // namespace

PointRounding BodyRounding::Of(const RobotDynamics::Body& body, const Vector3d& point) const {
  const BodySizes at(body);
  const double arm = point.norm(), speed = at.velocity + at.spin * arm;
  PointRounding off{.place = place};
  off.speed = velocity + Product(at.spin, spin, arm, place) + 16.0 * kRoundoff * speed;
  off.acceleration = acceleration + Product(at.spin1, spin1, arm, place) +
                     Product(at.spin, spin, speed, off.speed) +
                     32.0 * kRoundoff * (at.acceleration + at.spin1 * arm + at.spin * speed);
  return off;
}

double InertialMomentChange(const RobotDynamics::Body& body, double turned, double turn,
                            double turn1) {
  // By the product rule, ‖R I Rᵀ − I‖ ≤ ‖R − 1‖·‖I‖; R I Rᵀ has the norm of I.
  const double norm = body.inertia.about_com.norm(), change = std::min(turned, 2.0) * norm;
  const double speed = body.velocity.head<3>().norm(), fastest = speed + turn;
  return norm * turn1 + change * body.acceleration.head<3>().norm() + turn * norm * fastest +
         speed * (norm * turn + change * fastest);
}

double PlaceOfZmpRounding(const RobotDynamics& at_m, const Vector3d& zmp) {
  const Vector3d& O = at_m.O();
  return 64.0 * kRoundoff * (O.norm() + zmp.norm() + std::abs(zmp.z()) * at_m.Tilt().norm());
}

double WaistTurnRounding(const IntervalMotion& motion) {
  return motion.off.value[kWaistYaw] + 8.0 * kRoundoff;
}

double LegTurnRounding(const IntervalMotion& motion, Side side) {
  return Nth(motion.rounding.legs, Index(side)).turn + WaistTurnRounding(motion) + 16.0 * kRoundoff;
}

DynamicsRounding DynamicsRounding::At(const RobotModel& robot, const IntervalMotion& motion,
                                      const RobotDynamics& at_m, double gravity) {
  DynamicsRounding off;
  off.waist = OfWaist(robot, motion, at_m);
  AddArithmetic(at_m.waist(), &off.waist);
  off.known = IsFinite(off.waist);
  off.sums = {off.waist.moment, off.waist.force};
  const Eigen::Isometry3d& X_WB = motion.posture.X_WB;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const LegRounding& leg = Nth(motion.rounding.legs, Index(side));
    Vector6d& accelerations = Nth(off.accelerations, Index(side));
    accelerations = AccelerationRounding(motion, at_m, side, gravity);
    // The way from O to the waist and along the leg.
    const double far = std::abs(X_WB.translation().z()) + leg.chain;
    auto& links = Nth(off.legs, Index(side));
    FollowLeg(side, motion, at_m, off.waist, far + leg.points, accelerations, &links);
    off.known = off.known && accelerations.allFinite();
    for (const BodyRounding& link : links) {
      off.known = off.known && IsFinite(link);
      off.sums.moment += link.moment;
      off.sums.force += link.force;
    }
  }
  return off;
}

WrenchRounding DynamicsRounding::OfBody(const RobotDynamics::Body& body, const BodyRounding& off,
                                        const Vector3d& pole) {
  const Vector3d &com = body.inertia.com, turn = body.velocity.head<3>();
  const Vector3d velocity = body.velocity.tail<3>() + turn.cross(com);
  const Vector3d acceleration =
      body.acceleration.tail<3>() + body.acceleration.head<3>().cross(com) + turn.cross(velocity);
  const PointRounding of_com = off.Of(body, com);
  const double mass = body.inertia.mass;
  return {.moment = mass * Product((com - pole).norm(), of_com.place, acceleration.norm(),
                                   of_com.acceleration) +
                    InertialMomentChange(body, off.turn, off.spin, off.spin1) + off.moment +
                    pole.norm() * off.force,
          .force = mass * of_com.acceleration + off.force};
}

WrenchRounding DynamicsRounding::OfContact(const RobotDynamics& at_m, const Vector3d& pole) const {
  WrenchRounding sum = OfBody(at_m.waist(), waist, pole);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    for (size_t j = 0; j < 6; ++j) {
      const WrenchRounding link = OfBody(at_m.leg(side)[j], Nth(legs, Index(side))[j], pole);
      sum.moment += link.moment;
      sum.force += link.force;
    }
  }
  return sum;
}

}  // namespace halfstep
