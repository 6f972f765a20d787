#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <mutex>

#include "wpg/motion/motion_model.h"
#include "wpg/motion/rest_to_rest.h"
#include "wpg/robot/gravity.h"

namespace halfstep {

/// Linear inverted pendulum: a CoM at constant height z_c over a flat floor, no angular momentum
/// about it. Per horizontal axis c̈ = ω²·(c − p), or p = Z(c) with Z = Id − (z_c/g)·d²/dt². Its
/// half-steps go by RestToRest, whose CoM is at rest at both ends, exactly.
/// Source: [Kajita2001] eq. 4; [Perrin2011] §III.
class Lipm final : public MotionModel {
 public:
  /// z_c [m] > 0
  explicit Lipm(double com_height = 0.8) : com_height_(com_height) {}

  double com_height() const { return com_height_; }  ///< z_c [m]
  /// ω = √(g/z_c) [1/s].
  double omega() const { return std::sqrt(kGravity / com_height_); }

  /// Precondition: ω·T ∈ [0.5, 60], shift and bump_ramp in their ranges (std::logic_error).
  Proposal Propose(HalfStepKind kind, const HalfStepShape& shape, double duration) const override;
  Eigen::Vector2d ComAcceleration(const WalkJet& jet) const override;
  Eigen::Vector2d ComJerk(const WalkJet& jet) const override;
  std::vector<std::pair<std::string_view, double>> numbers() const override;

 private:
  std::shared_ptr<const RestToRest> Solved(double theta, double shift, double bump_ramp) const;

  double com_height_;
  // What Propose() solved last, and for which θ, shift and ramp.
  mutable std::mutex mutex_;
  mutable std::shared_ptr<const RestToRest> last_;
  mutable std::array<double, 3> last_of_{};
};

}  // namespace halfstep
