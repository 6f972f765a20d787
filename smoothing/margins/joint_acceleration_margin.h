#pragma once

#include <string>

#include "smoothing/margins/margin_statements.h"

namespace halfstep {

/// Limit − |q̈| of a leg joint [rad/s²]; +∞ for a joint of which the robot file states no limit; −∞
/// when a leg does not reach or is stretched to the singularity. Subject: 6·Index(Side) + joint.
/// Present where the robot file states a limit of any leg joint; where nothing is demanded
/// (kNotDemanded) it has no rows, and its proofs say nothing. Masses need not be known. Source:
/// wpg/README.md, "Dynamics of the whole robot"; smoothing/README.md, "Joint accelerations between
/// instants".
class JointAccelerationMargin final : public WholeFamily {
 public:
  /// Of the family `joint_acceleration`.
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kJointAcceleration,
      .name = "joint_acceleration",
      .unit = "rad/s²",
      .key = "joint_acceleration_rad_s2",
      .meaning =
          "inside the acceleration limits of the legs' joints, where the robot file states these; "
          "none: not demanded",
      .remedy =
          "a longer `half_step.duration_s`, shorter steps, a lower `half_step.via_height_m`; "
          "`acceleration_limits_rad_s2` of the robot file says what the joints are allowed",
      .scale = 5.0,
      .demanded = 0.0,
      .raised = true,
      .cost = MarginCost::kJointSpeeds,
      // A row of its own would be there for robots without limits, too.
      .row = MarginFamily::kJointSpeed,
      .may_be_none = true,
      .most = 500.0,
      .for_some_robots = true,
  };

  /// `place` is borrowed.
  explicit JointAccelerationMargin(const MarginPlace& place);

  bool present() const override { return present_; }
  int count() const override { return present_ ? 12 : 0; }
  int groups() const override { return present_ ? 1 : 0; }
  std::string Subject(const Margin& margin) const override;
  Margin Least(Instant* at, double enough) const override;
  void AddRows(Instant* at, SlackSink* rows) const override;

 protected:
  void AddBounds(const MarginInterval& interval, TightestStatement* tightest) const override;

 private:
  double Limit(Side side, Eigen::Index joint) const;

  const MarginPlace& place_;
  const bool present_;
};

}  // namespace halfstep
