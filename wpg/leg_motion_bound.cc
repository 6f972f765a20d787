#include "wpg/leg_motion_bound.h"

namespace halfstep {

LegExtents::LegExtents(const Leg& leg) {
  origin_B_ = {leg.hip_B, leg.hip_B, leg.hip_B, leg.joints[3].point_B, leg.ankle_B, leg.ankle_B};
  for (size_t i = 0; i < 6; ++i) X_BLink_[i] = leg.joints[i].X_BLink;
  double distance = (leg.X_BSole.translation() - leg.ankle_B).norm();
  for (size_t i = 6; i-- > 0;) {
    if (i < 5) distance += (origin_B_[i + 1] - origin_B_[i]).norm();
    to_sole_[i] = distance;
  }
}

double LegExtents::ToBody(int joint, const RobotBody& body) const {
  const size_t link = static_cast<size_t>(body.link), i = static_cast<size_t>(joint);
  // Both joint `link` and joint `link` + 1 are fixed in the link that carries the body.
  const size_t from = i <= link ? link : link + 1;
  double distance =
      (X_BLink_[link] * body.shape.center - origin_B_[from]).norm() + body.shape.radius;
  for (size_t j = std::min(i, from); j < std::max(i, from); ++j) {
    distance += (origin_B_[j + 1] - origin_B_[j]).norm();
  }
  return distance;
}

PointBound BoundChain(std::span<const ChainJoint> joints) {
  PointBound bound;
  for (size_t i = joints.size(); i-- > 0;) {
    const ChainJoint& j = joints[i];
    bound.acceleration +=
        (j.acceleration + j.speed * j.speed) * j.reach + 2.0 * j.speed * bound.speed;
    bound.speed += j.speed * j.reach;
  }
  return bound;
}

namespace {

// Given sup |q̇| ≤ s on the interval: sup |q̈|, or none when J may become singular.
std::optional<Vector6d> Accelerations(const LegExtents& extents, const Vector6d& angular_gain,
                                      const Vector6d& linear_gain, const Vector6d& s,
                                      const TwistRateBound& twist_rate, double h) {
  // Column j of J is (ω_j, ω_j × (p − o_j)); in time h it changes by at most (e_ω, e_v)_j, and
  // J̇q̇ is at most (angular, linear).
  double before = 0.0;  // Σ_{k<j} s_k
  double after = 0.0;   // Σ_{k≥j} s_k ρ_k
  for (int j = 0; j < 6; ++j) after += s[j] * extents.ToSole(j);
  double angular = twist_rate.angular, linear = twist_rate.linear;
  Eigen::Matrix2d G = Eigen::Matrix2d::Zero();
  for (int j = 0; j < 6; ++j) {
    const double reach = extents.ToSole(j);
    const double e_angular = h * before;
    const double e_linear = h * (2.0 * before * reach + after);
    G(0, 0) += e_angular * angular_gain[j];
    G(0, 1) += e_angular * linear_gain[j];
    G(1, 0) += e_linear * angular_gain[j];
    G(1, 1) += e_linear * linear_gain[j];
    after -= s[j] * reach;
    angular += s[j] * before;
    linear += s[j] * (s[j] * reach + 2.0 * after);
    before += s[j];
  }
  // |J(t)⁻¹r|_i ≤ a_i·X + b_i·Y with (X, Y) = (I − G)⁻¹(‖r_ω‖, ‖r_v‖).
  const double determinant = (1.0 - G(0, 0)) * (1.0 - G(1, 1)) - G(0, 1) * G(1, 0);
  if (!(G(0, 0) < 1.0 && G(1, 1) < 1.0 && determinant > 0.0)) return std::nullopt;
  const double X = ((1.0 - G(1, 1)) * angular + G(0, 1) * linear) / determinant;
  const double Y = (G(1, 0) * angular + (1.0 - G(0, 0)) * linear) / determinant;
  return Vector6d(angular_gain * X + linear_gain * Y);
}

}  // namespace

std::optional<JointBounds> BoundJoints(const LegExtents& extents, const Matrix6d& jacobian_inverse,
                                       const Vector6d& speeds, const TwistRateBound& twist_rate,
                                       double half_width) {
  const Vector6d angular_gain = jacobian_inverse.leftCols<3>().rowwise().norm();
  const Vector6d linear_gain = jacobian_inverse.rightCols<3>().rowwise().norm();
  const Vector6d at_midpoint = speeds.cwiseAbs();
  Vector6d assumed = at_midpoint;
  for (int attempt = 0; attempt < 6; ++attempt) {
    const auto acceleration =
        Accelerations(extents, angular_gain, linear_gain, assumed, twist_rate, half_width);
    if (!acceleration) return std::nullopt;
    const Vector6d implied = at_midpoint + half_width * *acceleration;
    // Strictly inside what was assumed: |q̇| cannot leave it, for it would have to pass `implied`.
    if ((implied.array() < assumed.array()).all()) return JointBounds{implied, *acceleration};
    assumed = at_midpoint + 1.2 * (implied - at_midpoint) + Vector6d::Constant(1e-9);
  }
  return std::nullopt;
}

}  // namespace halfstep
