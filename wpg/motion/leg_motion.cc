#include "wpg/motion/leg_motion.h"

#include <algorithm>

#include "wpg/motion/knee_match.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

// Of an upright frame whose origin moves as the quantity `x`, the one after it, and `height`.
// Rounding turns what is fixed in it by `turn_off`, and moves its points by `place_off`.
RigidMotion UprightMotion(const IntervalMotion& motion, const WalkThirds& thirds, int x, int height,
                          int yaw, double turn_off, double place_off) {
  const double h = motion.half_width;
  const WalkJet& off = motion.off;
  const Vector3d z = Vector3d::UnitZ();
  const auto place = [&](const WalkState& values) {
    return Vector3d(values[x], values[x + 1], values[height]);
  };
  const Range third = thirds.of(yaw);
  RigidMotion frame;
  frame.turn = {motion.jet.first[yaw] * z, h * motion.second[yaw] + off.first[yaw]};
  frame.turn1 = {motion.jet.second[yaw] * z, h * third.most() + off.second[yaw]};
  frame.turn2 = {third.center * z, third.radius};
  frame.p3 = {place(thirds.center), place(thirds.radius).norm()};
  frame.p2 = {place(motion.jet.second), h * frame.p3.most() + place(off.second).norm()};
  frame.p1 = {place(motion.jet.first),
              h * std::min(place(motion.second).norm(), frame.p2.most()) + place(off.first).norm()};
  frame.p = {place(motion.jet.value), h * frame.p1.most() + place(off.value).norm()};
  frame.arm_off = 2.0 * place_off;
  frame.turn_off = turn_off + off.value[yaw];
  frame.BoundTurned(h);
  return frame;
}

// A derivative drifts by no more than the next one lets it, and rounding.
void Lower(double radius, VectorBall* ball) { ball->radius = std::min(ball->radius, radius); }
void Lower(double radius, Range* range) { range->radius = std::min(range->radius, radius); }

// One leg between waist and sole.
class LinkChain {
 public:
  LinkChain(Side side, double half_width, const RigidMotion& waist, const RigidMotion& sole,
            const LegDrift& drift, const RobotDynamics& at_m, const KneeMatch& knee,
            const DynamicsRounding& off, double gravity)
      : h_(half_width),
        waist_(waist),
        sole_(sole),
        drift_(drift),
        O_(at_m.O()),
        leg_(at_m.leg(side)),
        off_(Nth(off.legs, Index(side))),
        knee_(knee),
        gravity_(gravity) {}

  // Places the links. With `true_thirds`, q⃛ is what it is at all times, and not any number.
  void Place(const std::array<JointRates, 6>& joints, bool true_thirds) {
    const auto turned = [&](const RigidMotion& base, size_t joint, double sign) {
      return Turned(base.At(knee_.points()[joint] - base.p.center),
                    sign * leg_[joint].screw.head<3>(), joints[joint], h_);
    };
    for (size_t j = 0; j < 3; ++j) {
      links[j] = turned(j == 0 ? waist_ : links[j - 1], j, 1.0);
      Narrow(j, true_thirds);
    }
    links[5] = sole_;
    links[5].arm_off = 2.0 * off_[5].place;
    links[5].turn_off = off_[5].turn;
    links[5].BoundTurned(h_);
    for (size_t j = 5; j > 3; --j) {
      links[j - 1] = turned(links[j], j, -1.0);
      Narrow(j - 1, true_thirds);
    }
    const RigidMotion shank = links[3].At(knee_.points()[3] - links[3].p.center);
    const RigidMotion thigh = turned(links[2], 3, 1.0);
    missing_turn = shank.turn2 - thigh.turn2;
    missing_velocity = shank.p3 - thigh.p3;
  }

  std::array<RigidMotion, 6> links;
  // Third derivatives of the shank less those of the thigh and the knee's joint, at the knee.
  VectorBall missing_turn, missing_velocity;

 private:
  // Drifts are of the exact link from the exact one at m, which is no farther from a ball's centre
  // than the computed one is from both.
  void Narrow(size_t j, bool true_thirds) {
    RigidMotion& link = links[j];
    link.arm_off = 2.0 * off_[j].place;
    link.turn_off = off_[j].turn;
    const RigidDrift& drift = drift_.links[j];
    const RobotDynamics::Body& at_m = leg_[j];
    const Vector3d point = link.p.center - O_, turn = at_m.velocity.head<3>();
    const Vector3d velocity = at_m.velocity.tail<3>() + turn.cross(point);
    const Vector3d acceleration = at_m.acceleration.tail<3>() - gravity_ * Vector3d::UnitZ() +
                                  at_m.acceleration.head<3>().cross(point) + turn.cross(velocity);
    const PointRounding of_point = off_[j].Of(at_m, point);
    const double off_turn = off_[j].spin + (link.turn.center - turn).norm();
    const double off_turn1 =
        off_[j].spin1 + (link.turn1.center - at_m.acceleration.head<3>()).norm();
    const double off1 = of_point.speed + (link.p1.center - velocity).norm();
    const double off2 = of_point.acceleration + (link.p2.center - acceleration).norm();
    Lower(drift.turn1 + off_turn1, &link.turn1);
    Lower(drift.p2 + off2, &link.p2);
    if (true_thirds) {
      Lower(h_ * link.turn2.most() + off_turn1, &link.turn1);
      Lower(h_ * link.p3.most() + off2, &link.p2);
    }
    Lower(std::min(drift.turn, h_ * link.turn1.most()) + off_turn, &link.turn);
    Lower(h_ * link.p2.most() + off1, &link.p1);
    Lower(std::min(drift.p, h_ * link.p1.most()) + of_point.place, &link.p);
    link.turned = std::min(drift.turned, h_ * link.turn.most()) + link.turn_off;
  }

  double h_;
  const RigidMotion &waist_, &sole_;
  const LegDrift& drift_;
  const Vector3d& O_;
  const RobotDynamics::LegBodies& leg_;
  const std::array<BodyRounding, 6>& off_;
  const KneeMatch& knee_;
  double gravity_;
};

}  // namespace

RigidMotion MotionOfWaist(const RobotModel& robot, const IntervalMotion& motion,
                          const WalkThirds& thirds) {
  RigidMotion waist = UprightMotion(motion, thirds, kComX, kWaistZ, kWaistYaw,
                                    WaistTurnRounding(motion), motion.rounding.origin);
  waist.p.center.z() += robot.waist_height;
  return waist;
}

RigidMotion MotionOfSole(const IntervalMotion& motion, const WalkThirds& thirds, Side side) {
  const int foot = FootIndex(side);
  return UprightMotion(motion, thirds, foot, foot + 2, foot + 3, LegTurnRounding(motion, side),
                       Nth(motion.rounding.legs, Index(side)).points);
}

std::optional<LegMotion> LegMotion::Over(Side side, const IntervalMotion& motion,
                                         const RigidMotion& waist, const RigidMotion& sole,
                                         const LegDrift& drift, const RobotDynamics& at_m,
                                         const DynamicsRounding& off, double gravity) {
  const double h = motion.half_width;
  const Vector6d& speeds_off = Nth(motion.rounding.legs, Index(side)).speeds;
  const Vector6d& accelerations_off = Nth(off.accelerations, Index(side));
  const Vector6d& speeds = Nth(motion.posture.speeds, Index(side));
  const KneeMatch knee(motion, side);
  LinkChain chain(side, h, waist, sole, drift, at_m, knee, off, gravity);
  std::array<JointRates, 6> joints;
  for (size_t j = 0; j < 6; ++j) {
    const Eigen::Index i = static_cast<Eigen::Index>(j);
    joints[j] = {.speed = {speeds[i], drift.joints[j].speed_drift + speeds_off[i]},
                 .acceleration = {at_m.accelerations(side)[i],
                                  drift.joints[j].acceleration_drift + accelerations_off[i]},
                 .third = {0.0, 0.0}};
  }
  // With q⃛ = 0 first, so that J q⃛ is what is missing.
  chain.Place(joints, /*true_thirds=*/false);
  std::array<double, 6> turned;
  for (size_t j = 0; j < 6; ++j) turned[j] = chain.links[j].turned;
  const auto third = knee.Solve(chain.missing_turn, chain.missing_velocity, turned);
  if (!third) return std::nullopt;
  for (size_t j = 0; j < 6; ++j) {
    JointRates& joint = joints[j];
    const Eigen::Index i = static_cast<Eigen::Index>(j);
    joint.third = {third->center[i], third->radius[i]};
    Lower(h * joint.third.most() + accelerations_off[i], &joint.acceleration);
    Lower(h * joint.acceleration.most() + speeds_off[i], &joint.speed);
  }
  chain.Place(joints, /*true_thirds=*/true);
  return LegMotion{chain.links};
}

}  // namespace halfstep
