#pragma once

#include <string>

#include "smoothing/margins/margin_statements.h"

namespace halfstep {

/// Distance of a joint's angle to the nearer of its two limits [rad]; −∞ when its leg does not
/// reach. Subject: 6·Index(Side) + joint.
class JointMargin final : public WholeFamily {
 public:
  /// Of the family `joint`.
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kJoint,
      .name = "joint",
      .unit = "rad",
      .key = "joint_rad",
      .meaning = "inside the joint limits",
      .remedy =
          "shorter steps, a lower via point, another `standing_posture_deg` or wider "
          "`joint_limits_deg` of the robot file",
      .scale = 0.05,
      .demanded = 0.0,
      .raised = true,
      .cost = MarginCost::kPosture,
      .row = MarginFamily::kJoint,
  };

  /// `place` is borrowed.
  explicit JointMargin(const MarginPlace& place) : WholeFamily(kTraits), place_(place) {}

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
