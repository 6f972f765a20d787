#include "wpg/motion/foot_loads.h"

#include <algorithm>
#include <limits>

#include "wpg/motion/robot_dynamics.h"

namespace halfstep {
namespace {

using Eigen::Vector2d;

// How far a point is from a sole's rectangle, negative inside, and the derivative of what of that
// is positive.
struct FromSole {
  double distance = 0.0;
  Vector2d slope{0, 0};

  FromSole(const Pose2& X_WF, const Vector2d& sole_size, const Vector2d& p_W) {
    const Eigen::Matrix2d R = X_WF.rotation();
    const Vector2d p_F = R.transpose() * (p_W - X_WF.position());
    const Vector2d beyond = p_F.cwiseAbs() - 0.5 * sole_size;
    distance = beyond.maxCoeff();
    if (!(distance > 0.0)) return;
    const Vector2d outside = beyond.cwiseMax(0.0);
    distance = outside.norm();
    slope = R * outside.cwiseProduct(p_F.cwiseSign()) / distance;
  }
};

// Of the right foot, when the soles are so far away.
double RightShare(double left, double right) {
  const double l = std::max(left, 0.0), r = std::max(right, 0.0);
  return l + r > 0.0 ? l / (l + r) : 0.5;
}

// λ(1 − λ) f_z (c_R − c_L) × ẑ as a wrench, for each newton of `product` = λ(1 − λ) f_z.
Vector6d Couple(double product, const Vector2d& between) {
  Vector6d couple = Vector6d::Zero();
  couple.head<2>() = product * Vector2d(between.y(), -between.x());
  return couple;
}

// What of it a right sole that is higher by a metre takes off: λ(1 − λ) f_t × ẑ.
Vector6d CoupleOfRise(double product, const Vector6d& wrench) {
  return Couple(product, wrench.segment<2>(3));
}

}  // namespace

FootLoads FootLoads::OneFoot(Side support) {
  FootLoads loads;
  loads.right_ = support == Side::kRight ? 1.0 : 0.0;
  return loads;
}

FootLoads FootLoads::BothFeet(const Pose2& X_WL, const Pose2& X_WR, const Vector2d& sole_size,
                              const Vector2d& zmp) {
  return Shared(X_WL, X_WR, sole_size, {zmp, zmp}, 0.0);
}

std::optional<FootLoads> FootLoads::OnLevels(const WalkState& x, const StandingHeights& heights,
                                             const Vector2d& sole_size,
                                             const std::array<Vector2d, 2>& zmps) {
  const FootLoads loads =
      Shared(FootPose(x, Side::kLeft), FootPose(x, Side::kRight), sole_size, zmps, heights.rise());
  if (!(std::max(loads.distances_[0], loads.distances_[1]) > 0.0)) return std::nullopt;
  return loads;
}

FootLoads FootLoads::Shared(const Pose2& X_WL, const Pose2& X_WR, const Vector2d& sole_size,
                            const std::array<Vector2d, 2>& zmps, double rise) {
  const FromSole left(X_WL, sole_size, zmps[0]), right(X_WR, sole_size, zmps[1]);
  FootLoads loads;
  loads.both_ = true;
  loads.between_ = X_WR.position() - X_WL.position();
  loads.rise_ = rise;
  loads.distances_ = {left.distance, right.distance};
  loads.right_ = RightShare(left.distance, right.distance);
  const double l = std::max(left.distance, 0.0), r = std::max(right.distance, 0.0);
  if (l + r > 0.0) {
    loads.right_slope_ = (r * left.slope - l * right.slope) / ((l + r) * (l + r));
    loads.tilt_slope_ = -rise * l * right.slope / ((l + r) * (l + r));
  }
  return loads;
}

Vector6d FootLoads::On(Side side, const Vector6d& contact) const {
  const double sign = side == Side::kRight ? 1.0 : -1.0;
  const Vector6d level =
      share(side) * contact + sign * Couple(right_ * (1.0 - right_) * contact[5], between_);
  if (rise_ == 0.0) return level;
  return level - sign * rise_ * CoupleOfRise(right_ * (1.0 - right_), contact);
}

Vector6d FootLoads::SlopeOn(Side side, const Vector6d& contact, const Vector6d& contact_slope,
                            const Vector2d& zmp_slope) const {
  const double sign = side == Side::kRight ? 1.0 : -1.0;
  double slope = right_slope_.dot(zmp_slope);
  if (rise_ != 0.0) slope += tilt_slope_.dot(TiltSlope(contact, contact_slope));
  const double product_slope =
      (1.0 - 2.0 * right_) * slope * contact[5] + right_ * (1.0 - right_) * contact_slope[5];
  const Vector6d level =
      share(side) * contact_slope + sign * slope * contact + sign * Couple(product_slope, between_);
  if (rise_ == 0.0) return level;
  return level - sign * rise_ *
                     (CoupleOfRise((1.0 - 2.0 * right_) * slope, contact) +
                      CoupleOfRise(right_ * (1.0 - right_), contact_slope));
}

double FootLoads::ShareDrift(double moved) const {
  if (!both_) return 0.0;
  const auto [left, right] = distances_;
  if (rise_ != 0.0 && std::max(left, right) <= moved) {
    return std::numeric_limits<double>::infinity();
  }
  return std::max(RightShare(left + moved, right - moved) - right_,
                  right_ - RightShare(left - moved, right + moved));
}

}  // namespace halfstep
