#include "wpg/motion/knee_match.h"

#include "wpg/motion/dynamics_rounding.h"
#include "wpg/motion/spatial.h"
#include "wpg/rounded.h"

namespace halfstep {
namespace {

// A bound v of all |δ| ≤ asked + change·|δ|: one with asked + change·v < v, for `change` then has a
// spectral radius below 1. None is found where `change` is too large.
std::optional<Vector6d> Bounded(const Vector6d& asked, const Matrix6d& change) {
  constexpr double kMore = 1.125;
  Vector6d v = asked;
  for (int round = 0; round < 3; ++round) v = asked + change * v;
  v = kMore * v.array() + 1e-9;
  if (((asked + change * v).array() < v.array()).all()) return v;
  return std::nullopt;
}

}  // namespace

KneeMatch::KneeMatch(const IntervalMotion& motion, Side side) {
  const size_t s = static_cast<size_t>(Index(side));
  const Posture& posture = motion.posture;
  const Eigen::Matrix3d& R = posture.X_WB.linear();
  for (size_t j = 0; j < 6; ++j) points_[j] = posture.X_WB * posture.frames[s].point_B[j];
  const Matrix6d& inverse = posture.jacobian_inverse[s];
  by_velocity_ = inverse.rightCols<3>() * R.transpose();
  by_turn_ = inverse.leftCols<3>() * R.transpose() -
             by_velocity_ * CrossMatrix(posture.X_WSole[s].translation() - points_[3]);
  turn_norms_ = by_turn_.rowwise().norm();
  velocity_norms_ = by_velocity_.rowwise().norm();
  // The inverse is that of the exact Jacobian but for this, and for the place of the knee.
  const LegRounding& leg = motion.rounding.legs[s];
  const double turn = WaistTurnRounding(motion);
  distance_off_ = 2.0 * leg.points;
  const double far = posture.X_WB.translation().norm() + leg.chain;
  const double lever_off = leg.pose.place + (leg.pose.turn + leg.q[4] + leg.q[5]) * leg.chain +
                           2.0 * leg.placed + 32.0 * kRoundoff * far;
  off_ = leg.of_inverse + Most(turn, lever_off + turn * leg.chain);
}

// A column of J is an axis, and the axis × its arm to the knee. Both turn with the links.
Matrix6d KneeMatch::Change(const std::array<double, 6>& turned) const {
  const std::array<double, 6> axis = {turned[0], turned[1], turned[2],
                                      turned[2], turned[4], turned[5]};
  std::array<double, 6> arm;
  arm[2] = turned[2] * Distance(2, 3);
  arm[1] = arm[2] + turned[1] * Distance(1, 2);
  arm[0] = arm[1] + turned[0] * Distance(0, 1);
  arm[3] = 0.0;
  arm[4] = turned[3] * Distance(4, 3);
  arm[5] = arm[4] + turned[4] * Distance(5, 4);
  Matrix6d change;
  for (size_t j = 0; j < 6; ++j) {
    change.col(static_cast<Eigen::Index>(j)) =
        off_ + Most(axis[j], axis[j] * Distance(j, 3) + arm[j]);
  }
  return change;
}

// J(m)⁻¹ times what is asked, and the change of J: |x| ≤ asked + change·|x|.
Vector6d KneeMatch::Lowered(Vector6d bound, double turn, double velocity,
                            const std::array<double, 6>& turned) const {
  const Vector6d asked = Most(turn, velocity);
  const Matrix6d change = Change(turned);
  for (int round = 0; round < 3; ++round) bound = bound.cwiseMin(asked + change * bound);
  return bound;
}

// x = J(m)⁻¹·centre + δ, and so J(t) δ = what is off the centre − (J(t) − J(m))·J(m)⁻¹·centre.
std::optional<KneeMatch::JointBall> KneeMatch::Solve(const VectorBall& turn,
                                                     const VectorBall& velocity,
                                                     const std::array<double, 6>& turned) const {
  const Matrix6d change = Change(turned);
  const Vector6d center = Joints(turn.center, velocity.center);
  constexpr double kSums = 64.0 * kRoundoff;
  const auto radius = Bounded(Most(turn.radius + kSums * turn.center.norm(),
                                   velocity.radius + kSums * velocity.center.norm()) +
                                  change * center.cwiseAbs(),
                              change);
  if (!radius) return std::nullopt;
  return JointBall{center, *radius};
}

}  // namespace halfstep
