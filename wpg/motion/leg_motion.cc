#include "wpg/motion/leg_motion.h"

#include <algorithm>

#include "wpg/motion/knee_match.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

// Of an upright frame whose origin moves as the quantity `x`, the one after it, and `height`.
RigidMotion UprightMotion(const IntervalMotion& motion, const WalkThirds& thirds, int x, int height,
                          int yaw) {
  const double h = motion.half_width;
  const Vector3d z = Vector3d::UnitZ();
  const auto place = [&](const WalkState& values) {
    return Vector3d(values[x], values[x + 1], values[height]);
  };
  const Range third = thirds.of(yaw);
  RigidMotion frame;
  frame.turn = {motion.jet.first[yaw] * z, h * motion.second[yaw]};
  frame.turn1 = {motion.jet.second[yaw] * z, h * third.most()};
  frame.turn2 = {third.center * z, third.radius};
  frame.p3 = {place(thirds.center), place(thirds.radius).norm()};
  frame.p2 = {place(motion.jet.second), h * frame.p3.most()};
  frame.p1 = {place(motion.jet.first), h * std::min(place(motion.second).norm(), frame.p2.most())};
  frame.p = {place(motion.jet.value), h * frame.p1.most()};
  frame.BoundTurned(h);
  return frame;
}

// A derivative drifts by no more than the next one lets it.
void Lower(double radius, VectorBall* ball) { ball->radius = std::min(ball->radius, radius); }
void Lower(double radius, Range* range) { range->radius = std::min(range->radius, radius); }

// One leg between waist and sole.
class LinkChain {
 public:
  LinkChain(Side side, double half_width, const RigidMotion& waist, const RigidMotion& sole,
            const LegDrift& drift, const RobotDynamics& at_m, const KneeMatch& knee)
      : h_(half_width),
        waist_(waist),
        sole_(sole),
        drift_(drift),
        leg_(at_m.leg(side)),
        knee_(knee) {}

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
  void Narrow(size_t j, bool true_thirds) {
    RigidMotion& link = links[j];
    const RigidDrift& drift = drift_.links[j];
    Lower(drift.turn1, &link.turn1);
    Lower(drift.p2, &link.p2);
    if (true_thirds) {
      Lower(h_ * link.turn2.most(), &link.turn1);
      Lower(h_ * link.p3.most(), &link.p2);
    }
    Lower(std::min(drift.turn, h_ * link.turn1.most()), &link.turn);
    Lower(h_ * link.p2.most(), &link.p1);
    Lower(std::min(drift.p, h_ * link.p1.most()), &link.p);
    link.turned = std::min(drift.turned, h_ * link.turn.most());
  }

  double h_;
  const RigidMotion &waist_, &sole_;
  const LegDrift& drift_;
  const RobotDynamics::LegBodies& leg_;
  const KneeMatch& knee_;
};

}  // namespace

RigidMotion MotionOfWaist(const RobotModel& robot, const IntervalMotion& motion,
                          const WalkThirds& thirds) {
  RigidMotion waist = UprightMotion(motion, thirds, kComX, kWaistZ, kWaistYaw);
  waist.p.center.z() += robot.waist_height;
  return waist;
}

RigidMotion MotionOfSole(const IntervalMotion& motion, const WalkThirds& thirds, Side side) {
  const int foot = FootIndex(side);
  return UprightMotion(motion, thirds, foot, foot + 2, foot + 3);
}

std::optional<LegMotion> LegMotion::Over(Side side, const IntervalMotion& motion,
                                         const RigidMotion& waist, const RigidMotion& sole,
                                         const LegDrift& drift, const RobotDynamics& at_m) {
  const double h = motion.half_width;
  const Vector6d& speeds = Nth(motion.posture.speeds, Index(side));
  const KneeMatch knee(motion, side);
  LinkChain chain(side, h, waist, sole, drift, at_m, knee);
  std::array<JointRates, 6> joints;
  for (size_t j = 0; j < 6; ++j) {
    const Eigen::Index i = static_cast<Eigen::Index>(j);
    joints[j] = {.speed = {speeds[i], drift.joints[j].speed_drift},
                 .acceleration = {at_m.accelerations(side)[i], drift.joints[j].acceleration_drift},
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
    Lower(h * joint.third.most(), &joint.acceleration);
    Lower(h * joint.acceleration.most(), &joint.speed);
  }
  chain.Place(joints, /*true_thirds=*/true);
  return LegMotion{chain.links};
}

}  // namespace halfstep
