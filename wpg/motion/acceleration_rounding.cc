#include "wpg/motion/acceleration_rounding.h"

#include <cmath>

#include "wpg/nth.h"
#include "wpg/rounded.h"

namespace halfstep {

using Eigen::Vector3d;

Vector6d AccelerationRounding(const IntervalMotion& motion, const RobotDynamics& dynamics,
                              Side side, double gravity) {
  const int foot = FootIndex(side);
  const WalkJet &jet = motion.jet, &off = motion.off;
  const LegRounding& leg = Nth(motion.rounding.legs, Index(side));
  const Posture& posture = motion.posture;
  const Vector3d sole = Nth(posture.X_WSole, Index(side)).translation() - dynamics.O();
  const Vector3d second = jet.second.segment<3>(foot);
  Vector6d demanded = UprightAcceleration(sole, jet.first.segment<3>(foot), second,
                                          jet.first[foot + 3], jet.second[foot + 3]);
  demanded[5] += gravity;
  const Vector6d missing = demanded - dynamics.leg(side)[5].acceleration;
  const Vector3d turn = missing.head<3>();

  // Sums of all speeds and accelerations that are turned or carried by the leg.
  const double rate = std::abs(jet.first[kWaistYaw]) + std::abs(jet.first[foot + 3]);
  const double speeds = Nth(posture.speeds, Index(side)).cwiseAbs().sum() + rate;
  const double yaws = std::abs(jet.second[kWaistYaw]) + std::abs(jet.second[foot + 3]);
  const double all = dynamics.accelerations(side).cwiseAbs().sum() + 2.0 * speeds * speeds + yaws;
  const double speed_off = leg.speeds.sum() + off.first[kWaistYaw] + off.first[foot + 3];
  const double size = leg.chain + sole.norm() + posture.X_WB.translation().z();
  const double carried =
      second.norm() + jet.second.segment<2>(kComX).norm() + std::abs(jet.second[kWaistZ]) + gravity;
  const double moved = jet.first.segment<3>(foot).norm() + posture.waist_velocity.norm();
  const double of_turn = turn.norm() + off.second[kWaistYaw] + off.second[foot + 3] +
                         3.0 * leg.turn * all + 4.0 * speeds * speed_off + 128.0 * kRoundoff * all;
  const double of_place =
      (missing.tail<3>() + turn.cross(sole)).norm() + off.second.segment<3>(foot).sum() +
      off.second.segment<2>(kComX).sum() + off.second[kWaistZ] + leg.chain * off.second[kWaistYaw] +
      3.0 * (leg.turn * leg.chain + leg.points) * all + 4.0 * leg.chain * speeds * speed_off +
      4.0 * speeds * leg.point_speeds + 4.0 * moved * (speed_off + leg.turn * speeds) +
      128.0 * kRoundoff * (all * size + carried + moved * speeds);
  const Matrix6d& inverse = Nth(posture.jacobian_inverse, Index(side));
  const Vector6d asked = of_turn * inverse.leftCols<3>().rowwise().norm() +
                         of_place * inverse.rightCols<3>().rowwise().norm();
  return ResolvedRounding(asked, leg.of_inverse);
}

}  // namespace halfstep
