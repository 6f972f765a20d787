#include "wpg/motion/acceleration_rounding.h"

#include <cmath>

#include "wpg/rounded.h"

namespace halfstep {

using Eigen::Vector3d;

namespace {

// Norms of the two halves of a matrix' rows, times a turn's and a translation's.
Vector6d RowsTimes(const Matrix6d& Y, double turn, double place) {
  return turn * Y.leftCols<3>().rowwise().norm() + place * Y.rightCols<3>().rowwise().norm();
}

}  // namespace

Vector6d AccelerationRounding(const IntervalMotion& motion, const RobotDynamics& dynamics,
                              const BodyRounding& waist, Side side, double gravity) {
  const size_t s = static_cast<size_t>(Index(side));
  const int foot = FootIndex(side), yaw = foot + 3;
  const WalkJet &jet = motion.jet, &off = motion.off;
  const LegRounding& leg = motion.rounding.legs[s];
  const Posture& posture = motion.posture;
  const RobotDynamics::LegBodies& links = dynamics.leg(side);
  const Eigen::Matrix3d& R = posture.X_WB.linear();
  const Vector3d sole = posture.X_WSole[s].translation() - dynamics.O();
  Vector3d pole = R * posture.frames[s].X_BLink[6].translation();
  pole.z() += posture.X_WB.translation().z();
  const auto about = [&pole](const Vector6d& x) {
    return Spatial(x.head<3>(), x.tail<3>() + x.head<3>().cross(pole));
  };
  const Vector3d foot1 = jet.first.segment<3>(foot), foot2 = jet.second.segment<3>(foot);
  Vector6d demanded = UprightAcceleration(sole, foot1, foot2, jet.first[yaw], jet.second[yaw]);
  demanded[5] += gravity;
  const Vector6d missing = about(demanded - links[5].acceleration);

  const Vector6d of_waist = about(dynamics.waist().velocity);
  const Vector6d last = about(links[5].velocity), last1 = about(links[5].acceleration);

  // Sums of all speeds and accelerations that are turned or carried by the leg.
  const double rate = std::abs(jet.first[kWaistYaw]) + std::abs(jet.first[yaw]);
  const double speeds = posture.speeds[s].cwiseAbs().sum() + rate;
  const double all = dynamics.accelerations(side).cwiseAbs().sum() + 2.0 * speeds * speeds +
                     std::abs(jet.second[kWaistYaw]) + std::abs(jet.second[yaw]);
  const double size = leg.chain + sole.norm() + posture.X_WB.translation().z();
  const double carried =
      foot2.norm() + jet.second.segment<2>(kComX).norm() + std::abs(jet.second[kWaistZ]) + gravity;
  const double moved = foot1.norm() + posture.waist_velocity.norm() + of_waist.tail<3>().norm();
  // Of the waist: how its errors move what hangs on it.
  const Vector6d hung = last - of_waist, hung1 = last1 - about(dynamics.waist().acceleration);
  const double w = hung.head<3>().norm(), v = hung.tail<3>().norm(), w1 = hung1.head<3>().norm();
  const double arm = pole.norm(), place = waist.place + arm * waist.turn;
  const double sole_off = off.value.segment<3>(foot).sum() + 4.0 * kRoundoff * arm;
  const double sole1_off = off.first.segment<3>(foot).sum();
  const double bent = leg.q.sum(), bent1 = leg.speeds.sum();
  // All but what is of first order in the errors of angles and speeds.
  const double bent2 = leg.turn * (leg.turn + 64.0 * kRoundoff);
  const double beyond = 64.0 * (bent2 * all + leg.turn * bent1 * speeds + bent1 * bent1);
  const double turn = missing.head<3>().norm() + off.second[yaw] + waist.spin1 + waist.spin * w +
                      2.0 * waist.turn * (w1 + rate * w) +
                      (3.0 * leg.placed_turn + 128.0 * kRoundoff) * all + beyond;
  const double along =
      missing.tail<3>().norm() + off.second.segment<3>(foot).sum() +
      std::abs(jet.second[yaw]) * sole_off + off.second[yaw] * leg.pose.place +
      std::abs(jet.first[yaw]) * sole1_off + off.first[yaw] * (foot1.norm() + sole1_off) +
      waist.acceleration + arm * waist.spin1 + waist.spin * v +
      (waist.velocity + arm * waist.spin) * w +
      2.0 *
          (waist.turn * (hung1.tail<3>().norm() + rate * v + moved * w) + place * (w1 + rate * w)) +
      9.0 * leg.placed * all + 3.0 * leg.placed_turn * moved * speeds +
      128.0 * kRoundoff * (all * size + carried + moved * speeds) + leg.chain * beyond +
      64.0 * moved * (bent2 * speeds + leg.turn * bent1);
  // What is, by the norms of ∂A/∂q̇ and ∂A/∂q: links turn and are carried by no more than the sums
  // above, and no axis is farther from the sole than the chain is long.
  const double swept = of_waist.tail<3>().norm();
  const double bent_turn = speeds * bent1 + all * bent;
  const double bent_along = (2.0 * leg.chain * speeds + swept) * bent1 +
                            (3.0 * leg.chain * all + 2.0 * swept * speeds) * bent;
  // Rows of Y have the same norms in the axes of W.
  const Vector6d asked =
      RowsTimes(posture.jacobian_inverse[s], turn + bent_turn, along + bent_along);
  return ResolvedRounding(asked, leg.of_inverse);
}

}  // namespace halfstep
