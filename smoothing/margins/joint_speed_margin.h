#pragma once

#include <string>

#include "smoothing/margins/margin_statements.h"

namespace halfstep {

/// Joint speed limit, times MarginLimits::joint_speed_scale, − |q̇| [rad/s]; −∞ when a leg does not
/// reach or is stretched to the singularity. Subject: 6·Index(Side) + joint.
class JointSpeedMargin final : public WholeFamily {
 public:
  /// Of the family `joint_speed`.
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kJointSpeed,
      .name = "joint_speed",
      .unit = "rad/s",
      .key = "joint_speed_rad_s",
      .meaning = "inside the joint speed limits",
      .remedy = "a longer `half_step.duration_s`, a lower `half_step.via_height_m`, shorter steps",
      .scale = 0.5,
      .demanded = 0.0,
      .raised = true,
      .cost = MarginCost::kJointSpeeds,
      .row = MarginFamily::kJointSpeed,
  };

  /// `place` is borrowed.
  explicit JointSpeedMargin(const MarginPlace& place) : WholeFamily(kTraits), place_(place) {}

  int count() const override;
  std::string Subject(const Margin& margin) const override;
  Margin Least(Instant* at, double enough) const override;
  void AddRows(Instant* at, SlackSink* rows) const override;

 protected:
  void AddBounds(const MarginInterval& interval, TightestStatement* tightest) const override;

 private:
  const MarginPlace& place_;
};

}  // namespace halfstep
