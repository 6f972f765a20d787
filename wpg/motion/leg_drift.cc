#include "wpg/motion/leg_drift.h"

#include <algorithm>
#include <cmath>

#include "wpg/motion/knee_match.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

// One leg between waist and sole.
class Chain {
 public:
  Chain(Side side, const IntervalMotion& motion, const RigidDrift& waist, const RigidDrift& sole,
        const RobotDynamics& at_m, const DynamicsRounding& off)
      : waist_(waist),
        sole_(sole),
        turns_(Nth(motion.joints, Index(side)).turns),
        h_(motion.half_width),
        knee_(motion, side),
        waist_point_(motion.posture.X_WB.translation()),
        sole_point_(Nth(motion.posture.X_WSole, Index(side)).translation()) {
    const auto& links_off = Nth(off.legs, Index(side));
    hip_off_ = 2.0 * links_off[0].place;
    sole_off_ = 2.0 * links_off[5].place;
    for (size_t j = 0; j < 6; ++j) {
      const RobotDynamics::Body& link = at_m.leg(side)[j];
      speed_[j] = link.velocity.head<3>().norm() + links_off[j].spin;
      acceleration_[j] = link.acceleration.head<3>().norm() + links_off[j].spin1;
      const bool on_hip = LegAnchors::OnHip(static_cast<int>(j));
      const RobotDynamics::Body& base = on_hip ? at_m.waist() : at_m.leg(side)[5];
      from_base_[j] = (link.acceleration - base.acceleration).head<3>().norm() +
                      links_off[j].spin1 + (on_hip ? off.waist : links_off[5]).spin1;
    }
  }

  // Places the links. With `true_motion`, joints move as the robot's do, not with the q̈ of m.
  void Place(const std::array<JointDrift, 6>& joints, bool true_motion) {
    RigidDrift parent = waist_.At((knee_.points()[0] - waist_point_).norm() + hip_off_);
    for (size_t j = 0; j < 3; ++j) {
      links[j] = Turned(parent, joints[j], speed_[j], acceleration_[j], h_);
      Narrow(j, waist_, true_motion);
      parent = links[j].At(knee_.Distance(j, j + 1));
    }
    links[5] = sole_;
    links[4] = Turned(sole_.At((knee_.points()[5] - sole_point_).norm() + sole_off_), joints[5],
                      speed_[4], acceleration_[4], h_);
    Narrow(4, sole_, true_motion);
    links[3] =
        Turned(links[4].At(knee_.Distance(5, 4)), joints[4], speed_[3], acceleration_[3], h_);
    Narrow(3, sole_, true_motion);
  }

  // Bounds of how much q̈ drifts, from links that were placed with the q̈ of m, and from `bound`.
  // With q̈(t) = q̈(m) + δ the knee of thigh and shank is J(t) δ = E(t) apart, E(m) = 0.
  Vector6d AccelerationDrift(const std::array<JointDrift, 6>& joints, const Vector6d& bound) const {
    // The knee's joint hangs on the thigh; it moves with the q̈ of m, too.
    const RigidDrift knee = Turned(links[2].At(knee_.Distance(2, 3)), joints[3], /*speed=*/0.0,
                                   /*acceleration=*/0.0, h_);
    const RigidDrift shank = links[3].At(knee_.Distance(4, 3));
    std::array<double, 6> turned;
    for (size_t j = 0; j < 6; ++j) turned[j] = links[j].turned;
    return knee_.Lowered(bound, knee.turn1 + shank.turn1, knee.p2 + shank.p2, turned);
  }

  LegDrift Result(const std::array<JointDrift, 6>& joints) const {
    const std::array<Vector3d, 6>& at = knee_.points();
    return {links, {at[0], at[1], at[2], at[4], at[5], sole_point_}, joints};
  }

  std::array<RigidDrift, 6> links;

 private:
  // A link's ω̇ is its base's, and what the bounds of its turning as seen from there let it be.
  void Narrow(size_t j, const RigidDrift& base, bool true_motion) {
    RigidDrift& link = links[j];
    const TurnBound& seen = turns_[j];
    const double seen_in_W = seen.acceleration + base.fastest() * seen.speed;
    link.turn = std::min(link.turn, h_ * (base.acceleration + base.turn1 + seen_in_W));
    link.turned = h_ * link.fastest();
    if (true_motion) link.turn1 = std::min(link.turn1, base.turn1 + from_base_[j] + seen_in_W);
  }

  const RigidDrift &waist_, &sole_;
  const std::array<TurnBound, 6>& turns_;  // of the links, seen from waist or sole
  double h_;
  KneeMatch knee_;
  Vector3d waist_point_, sole_point_;
  std::array<double, 6> speed_, acceleration_;  // of the links at m
  std::array<double, 6> from_base_;             // ‖ω̇ less that of waist or sole‖ at m
  double hip_off_, sole_off_;  // of distances of two points of the first and last link, by rounding
};

// Of an upright frame whose origin moves as the quantity `x`, the one after it, and `z`.
RigidDrift UprightDrift(const IntervalMotion& motion, const WalkThirds& thirds, int x, int z,
                        int yaw) {
  const double h = motion.half_width;
  const WalkState &first = motion.jet.first, &second = motion.jet.second, &most = motion.second;
  const auto norm = [&](const WalkState& values) {
    return Vector3d(values[x], values[x + 1], values[z]).norm();
  };
  // At m, no less than the exact ones.
  const WalkState &first_off = motion.off.first, &second_off = motion.off.second;
  RigidDrift drift;
  drift.speed = std::abs(first[yaw]) + first_off[yaw];
  drift.acceleration = std::abs(second[yaw]) + second_off[yaw];
  // A second derivative drifts by no more than the third lets it, and by no more than it can be.
  drift.turn1 = h * thirds.of(yaw).most();
  drift.turn1 = std::min(drift.turn1, drift.acceleration + most[yaw]);
  drift.p2 = h * norm(thirds.center.cwiseAbs() + thirds.radius);
  drift.p2 = std::min(drift.p2, norm(second.cwiseAbs() + second_off + most));
  drift.turn = h * std::min(most[yaw], drift.acceleration + drift.turn1);
  drift.p = h * (norm(first.cwiseAbs() + first_off) +
                 h * std::min(norm(most), norm(second.cwiseAbs() + second_off) + drift.p2));
  drift.turned = h * drift.fastest();
  return drift;
}

}  // namespace

RigidDrift DriftOfWaist(const RobotModel& robot, const IntervalMotion& motion,
                        const WalkThirds& thirds) {
  // The point below the CoM moves as that; the waist's origin is com_x_B behind it.
  return UprightDrift(motion, thirds, kComX, kWaistZ, kWaistYaw).At(std::abs(robot.com_x_B));
}

RigidDrift DriftOfSole(const IntervalMotion& motion, const WalkThirds& thirds, Side side) {
  const int foot = FootIndex(side);
  return UprightDrift(motion, thirds, foot, foot + 2, foot + 3);
}

LegDrift LegDrift::Over(Side side, const IntervalMotion& motion, const RigidDrift& waist,
                        const RigidDrift& sole, const RobotDynamics& at_m,
                        const DynamicsRounding& off) {
  const size_t s = static_cast<size_t>(Index(side));
  const Vector6d& most = motion.joints[s].acceleration;
  const Vector6d accelerations = at_m.accelerations(side).cwiseAbs() + off.accelerations[s];
  std::array<JointDrift, 6> joints;
  for (size_t j = 0; j < 6; ++j) {
    const Eigen::Index i = static_cast<Eigen::Index>(j);
    joints[j] = {.speed = std::abs(motion.posture.speeds[s][i]) + motion.rounding.legs[s].speeds[i],
                 .acceleration = accelerations[i],
                 .speed_drift = motion.half_width * most[i],
                 .acceleration_drift = 0.0};
  }
  Chain chain(side, motion, waist, sole, at_m, off);
  chain.Place(joints, /*true_motion=*/false);
  const Vector6d drift = chain.AccelerationDrift(joints, accelerations + most);
  for (size_t j = 0; j < 6; ++j) {
    joints[j].acceleration_drift = drift[static_cast<Eigen::Index>(j)];
  }
  chain.Place(joints, /*true_motion=*/true);
  return chain.Result(joints);
}

}  // namespace halfstep
