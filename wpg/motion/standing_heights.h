#pragma once

#include <cmath>
#include <optional>

#include "wpg/geometry/side.h"
#include "wpg/motion/walk_state.h"

namespace halfstep {

/// At which heights the soles stand that carry the robot. Where one stands alone, its height is
/// that of both.
class StandingHeights {
 public:
  /// What is less apart, or less away from z = 0, counts as level: rounding of superposed tracks is
  /// far below it. Proofs contain what that does (MarginInterval::SolesOff) [m].
  static constexpr double kLevel = 1e-10;

  /// In a walk's quantities x; `only` is the foot that stands alone, where one does.
  StandingHeights(const WalkState& x, const std::optional<Side>& only)
      : left_(Snapped(x[FootIndex(only.value_or(Side::kLeft)) + 2])),
        right_(Snapped(x[FootIndex(only.value_or(Side::kRight)) + 2])) {
    if (std::abs(right_ - left_) < kLevel) right_ = left_;
  }

  /// Of that sole, in W [m].
  double of(Side side) const { return side == Side::kLeft ? left_ : right_; }
  /// The plane halfway between them, in W [m].
  double middle() const { return 0.5 * (left_ + right_); }
  /// How much the right one is higher [m].
  double rise() const { return right_ - left_; }
  /// Whether all that stands does so at one height.
  bool level() const { return left_ == right_; }

 private:
  static double Snapped(double height) { return std::abs(height) < kLevel ? 0.0 : height; }

  double left_, right_;
};

}  // namespace halfstep
