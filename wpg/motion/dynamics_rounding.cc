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
  BodySizes() = default;
  explicit BodySizes(const RobotDynamics::Body& body)
      : spin(body.velocity.head<3>().norm()),
        velocity(body.velocity.tail<3>().norm()),
        spin1(body.acceleration.head<3>().norm()),
        acceleration(body.acceleration.tail<3>().norm()) {}
  double spin = 0.0, velocity = 0.0, spin1 = 0.0, acceleration = 0.0;
};

// I a + v ×* I v as ForceOf computes it: products of at most six factors and sums of at most nine.
void AddArithmetic(const RobotDynamics::Body& body, const BodySizes& at, BodyRounding* off) {
  const SpatialInertia& inertia = body.inertia;
  const double arm = inertia.com.norm(), norm = inertia.about_com.norm();
  const double speed = at.velocity + at.spin * arm;
  const double force = inertia.mass * (at.acceleration + at.spin1 * arm + at.spin * speed);
  off->force = 64.0 * kRoundoff * force;
  off->moment =
      64.0 * kRoundoff *
      (arm * force + inertia.mass * at.velocity * speed + norm * (at.spin1 + at.spin * at.spin));
}

// Of a point of the body that far from O.
PointRounding OfPoint(const BodyRounding& body, const BodySizes& at, double arm) {
  const double speed = at.velocity + at.spin * arm;
  PointRounding off{.place = body.place};
  off.speed =
      body.velocity + Product(at.spin, body.spin, arm, body.place) + 16.0 * kRoundoff * speed;
  off.acceleration = body.acceleration + Product(at.spin1, body.spin1, arm, body.place) +
                     Product(at.spin, body.spin, speed, off.speed) +
                     32.0 * kRoundoff * (at.acceleration + at.spin1 * arm + at.spin * speed);
  return off;
}

BodyRounding OfWaist(const RobotModel& robot, const IntervalMotion& motion, const BodySizes& at) {
  const WalkJet &jet = motion.jet, &off = motion.off;
  const double height = std::abs(motion.posture.X_WB.translation().z());
  const double speed = motion.posture.waist_velocity.norm(),
               speed_off = motion.rounding.origin_speed;
  const double rate = std::abs(jet.first[kWaistYaw]), rate1 = std::abs(jet.second[kWaistYaw]);
  const double arm = std::abs(robot.com_x_B);
  BodyRounding waist{.turn = WaistTurnRounding(motion),
                     .place = motion.rounding.waist,
                     .spin = off.first[kWaistYaw],
                     .spin1 = off.second[kWaistYaw]};
  const double origin = motion.rounding.origin;
  const double place = Product(rate, waist.spin, height, origin);
  waist.velocity = speed_off + place + 16.0 * kRoundoff * (speed + rate * height);
  const double turning = rate1 + rate * rate;
  const double turning_off = waist.spin1 + Product(rate, waist.spin, rate, waist.spin);
  const double of_origin =
      off.second[kComX] + off.second[kComY] + off.second[kWaistZ] +
      arm * (turning_off + (waist.turn + 8.0 * kRoundoff) * (turning + turning_off));
  waist.acceleration =
      of_origin + Product(rate1, waist.spin1, height, origin) +
      Product(rate, waist.spin, speed, speed_off) +
      32.0 * kRoundoff * (at.acceleration + arm * turning + rate1 * height + rate * speed);
  return waist;
}

// Of the body that is the sole: what it misses of the sole's motion, which is given.
BodyRounding OfSole(Side side, const IntervalMotion& motion, const RobotDynamics& at_m,
                    double gravity) {
  const size_t s = static_cast<size_t>(Index(side));
  const int foot = FootIndex(side), yaw = foot + 3;
  const WalkJet &jet = motion.jet, &off = motion.off;
  const Eigen::Isometry3d &placed = motion.posture.X_WLink[s][6], &X = motion.posture.X_WSole[s];
  const Vector3d sole = X.translation() - at_m.O();
  const Vector3d foot1 = jet.first.segment<3>(foot), foot2 = jet.second.segment<3>(foot);
  const double arm = sole.norm(), speed = foot1.norm(),
               speed_off = off.first.segment<3>(foot).sum();
  const double rate = std::abs(jet.first[yaw]), rate1 = std::abs(jet.second[yaw]);
  const double place_off = off.value.segment<3>(foot).sum() + 4.0 * kRoundoff * arm;
  const Vector6d missing =
      UprightVelocity(sole, foot1, jet.first[yaw]) - at_m.leg(side)[5].velocity;
  Vector6d missing1 = UprightAcceleration(sole, foot1, foot2, jet.first[yaw], jet.second[yaw]) -
                      at_m.leg(side)[5].acceleration;
  missing1[5] += gravity;
  const BodySizes at(at_m.leg(side)[5]);
  BodyRounding body;
  body.turn = 0.75 * (placed.linear() - X.linear()).norm() + off.value[yaw] + 24.0 * kRoundoff;
  body.place = (placed.translation() - X.translation()).norm() + place_off;
  body.spin = missing.head<3>().norm() + off.first[yaw] + 16.0 * kRoundoff * (rate + at.spin);
  body.velocity = missing.tail<3>().norm() + speed_off +
                  Product(rate, off.first[yaw], arm, place_off) +
                  16.0 * kRoundoff * (speed + rate * arm + at.velocity);
  body.spin1 = missing1.head<3>().norm() + off.second[yaw] + 16.0 * kRoundoff * (rate1 + at.spin1);
  body.acceleration =
      missing1.tail<3>().norm() + off.second.segment<3>(foot).sum() +
      Product(rate1, off.second[yaw], arm, place_off) +
      Product(rate, off.first[yaw], speed, speed_off) +
      32.0 * kRoundoff * (foot2.norm() + gravity + rate1 * arm + rate * speed + at.acceleration);
  return body;
}

// Goes along a leg from a base, joint by joint: the sum or the difference that RobotDynamics takes.
class LegWay {
 public:
  LegWay(Side side, const IntervalMotion& motion, const RobotDynamics& at_m,
         const Vector6d& accelerations_off)
      : leg_(Nth(motion.rounding.legs, Index(side))),
        links_(at_m.leg(side)),
        speeds_(Nth(motion.posture.speeds, Index(side))),
        accelerations_(at_m.accelerations(side)),
        accelerations_off_(accelerations_off) {
    const Posture& posture = motion.posture;
    const auto& frames = Nth(posture.frames, Index(side));
    for (size_t j = 0; j < 6; ++j) {
      points_[j] = posture.X_WB * frames.point_B[j] - at_m.O();
      sizes_[j] = BodySizes(links_[j]);
      arms_[j] = links_[j].screw.tail<3>().norm();
      added_ += std::abs(accelerations_[static_cast<Eigen::Index>(j)]) * (1.0 + arms_[j]);
    }
    points_[6] = Nth(posture.X_WSole, Index(side)).translation() - at_m.O();
    far_ = 12.0 * kRoundoff *
           (posture.X_WB.translation().cwiseAbs().sum() + at_m.O().cwiseAbs().sum() + leg_.chain);
  }

  // Links 0–2 from the waist.
  void Down(const BodyRounding& waist, const BodySizes& of_waist, const Vector3d& origin,
            std::array<BodyRounding, 6>* links) {
    Begin(waist, (points_[0] - origin).norm());
    for (size_t j = 0; j < 3; ++j) {
      Joint(j, j == 0 ? of_waist : sizes_[j - 1]);
      (*links)[j] = Link(j, points_[j], points_[j + 1]);
    }
  }
  // Links 5–3 from the sole.
  void Up(const BodyRounding& sole, std::array<BodyRounding, 6>* links) {
    Begin(sole, 0.0);
    turn_ += leg_.placed_turn;
    for (size_t j = 6; j > 3; --j) {
      if (j < 6) Joint(j, sizes_[j]);
      (*links)[j - 1] = Link(j - 1, points_[j], points_[j - 1]);
    }
  }

 private:
  void Begin(const BodyRounding& base, double distance) {
    link_ = base;
    turn_ = base.turn;
    place_ = base.place + distance * base.turn;
  }
  // The body beyond a joint from the one before, `at`.
  void Joint(size_t joint, const BodySizes& at) {
    const Eigen::Index i = static_cast<Eigen::Index>(joint);
    const double q1 = std::abs(speeds_[i]), q2 = std::abs(accelerations_[i]);
    const double off1 = leg_.speeds[i], off2 = accelerations_off_[i];
    // Of the joint's twist q̇ S and of q̈ S.
    const double turn = turn_ + leg_.placed_turn + 16.0 * kRoundoff;
    const double arm = arms_[joint];
    const double lever = place_ + leg_.placed + 8.0 * kRoundoff * arm +
                         points_[joint].norm() * turn;  // of a point × an axis
    const double w = Product(q1, off1, 1.0, turn), v = Product(q1, off1, arm, lever);
    const double both = at.spin + q1;  // not less than that of either body
    link_.spin1 += Product(q2, off2, 1.0, turn) + Product(at.spin, link_.spin, q1, w) +
                   64.0 * kRoundoff * (added_ + at.spin1 + both * q1);
    link_.acceleration +=
        Product(q2, off2, arm, lever) + Product(at.spin, link_.spin, arm * q1, v) +
        Product(at.velocity, link_.velocity, q1, w) +
        64.0 * kRoundoff * (added_ + at.acceleration + (both * arm + at.velocity) * q1);
    link_.spin += w + 16.0 * kRoundoff * (at.spin + q1);
    link_.velocity += v + 16.0 * kRoundoff * (at.velocity + arm * q1);
    turn_ += leg_.q[i];
  }
  // Of a link between two points, of which place_ is of the first.
  BodyRounding Link(size_t link, const Vector3d& from, const Vector3d& to) {
    const double length = (to - from).norm() + 2.0 * leg_.placed;
    link_.turn = turn_ + leg_.placed_turn + 16.0 * kRoundoff;
    link_.place = place_ + turn_ * std::max(length, (links_[link].inertia.com - from).norm()) +
                  leg_.placed + far_;
    place_ += turn_ * length;
    BodyRounding whole = link_;
    AddArithmetic(links_[link], sizes_[link], &whole);
    return whole;
  }

  const LegRounding& leg_;
  const RobotDynamics::LegBodies& links_;
  const Vector6d &speeds_, &accelerations_, &accelerations_off_;
  std::array<Vector3d, 7> points_;  // axes' and the sole's, from O
  std::array<BodySizes, 6> sizes_;
  std::array<double, 6> arms_;  // of the axes from O
  double far_, added_ = 0.0;    // of coordinates in W; what q̈ adds, all joints together
  BodyRounding link_;
  double turn_ = 0.0, place_ = 0.0;  // of what is exactly at the computed angles, at a point
};

bool IsFinite(const BodyRounding& off) {
  return std::isfinite(off.turn + off.place + off.spin + off.velocity + off.spin1 +
                       off.acceleration + off.moment + off.force);
}

}  // namespace

PointRounding BodyRounding::Of(const RobotDynamics::Body& body, const Vector3d& point) const {
  return OfPoint(*this, BodySizes(body), point.norm());
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
  const BodySizes of_waist(at_m.waist());
  off.waist = OfWaist(robot, motion, of_waist);
  AddArithmetic(at_m.waist(), of_waist, &off.waist);
  off.known = IsFinite(off.waist);
  off.sums = {off.waist.moment, off.waist.force};
  const Eigen::Isometry3d& X_WB = motion.posture.X_WB;
  BodyRounding hung_on = off.waist;  // whose place is that of its origin
  hung_on.place = motion.rounding.origin;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    Vector6d& accelerations = Nth(off.accelerations, Index(side));
    accelerations = AccelerationRounding(motion, at_m, hung_on, side, gravity);
    auto& links = Nth(off.legs, Index(side));
    LegWay way(side, motion, at_m, accelerations);
    way.Down(hung_on, of_waist, X_WB.translation() - at_m.O(), &links);
    way.Up(OfSole(side, motion, at_m, gravity), &links);
    // On either way each link is off by at least as much as the one before.
    off.known = off.known && accelerations.allFinite() && IsFinite(links[2]) && IsFinite(links[3]);
    for (const BodyRounding& link : links) {
      off.sums.moment += link.moment;
      off.sums.force += link.force;
    }
  }
  off.known = off.known && std::isfinite(off.sums.moment + off.sums.force);
  return off;
}

WrenchRounding DynamicsRounding::OfBody(const RobotDynamics::Body& body, const BodyRounding& off,
                                        const Vector3d& pole) {
  const BodySizes at(body);
  const Vector3d& com = body.inertia.com;
  const double arm = com.norm(), mass = body.inertia.mass;
  const PointRounding of_com = OfPoint(off, at, arm);
  const double acceleration =
      at.acceleration + at.spin1 * arm + at.spin * (at.velocity + at.spin * arm);
  return {.moment =
              mass * Product((com - pole).norm(), of_com.place, acceleration, of_com.acceleration) +
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
