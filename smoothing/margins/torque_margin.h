#pragma once

#include <array>
#include <string>

#include "smoothing/margins/margin_statements.h"
#include "wpg/motion/foot_loads.h"

namespace halfstep {

/// Torque limit − |torque| of a leg joint [N m], of the whole robot's dynamics: the foot that
/// stands alone carries all of what the floor gives, two feet share it (FootLoads). +∞ for a joint
/// whose limit is not known; −∞ when a leg does not reach or is stretched to the singularity,
/// masses are not known, or the floor does not push. Subject: 6·Index(Side) + joint. Where nothing
/// is demanded (kNotDemanded) it has no rows, and its proofs say nothing. Source: wpg/README.md,
/// "Joint torques".
class TorqueMargin final : public WholeFamily {
 public:
  /// Of the family `torque`.
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kTorque,
      .name = "torque",
      .unit = "N m",
      .key = "torque_n_m",
      .meaning =
          "inside the torque limits of the legs' joints, where these are known; none: not demanded",
      .remedy =
          "a longer `half_step.duration_s`, shorter steps, a lower `half_step.via_height_m`; "
          "`effort_limits_n_m` of the robot file says what the joints give",
      .scale = 5.0,
      .demanded = 0.0,
      .raised = true,
      .cost = MarginCost::kJointSpeeds,
      .row = MarginFamily::kTorque,
      .may_be_none = true,
      .most = 500.0,
  };

  /// `place` is borrowed.
  explicit TorqueMargin(const MarginPlace& place) : WholeFamily(kTraits), place_(place) {}

  int count() const override;
  std::string Subject(const Margin& margin) const override;
  Margin Least(Instant* at, double enough) const override;
  void AddRows(Instant* at, SlackSink* rows) const override;

 protected:
  void AddBounds(const MarginInterval& interval, TightestStatement* tightest) const override;

 private:
  Margin LeastOf(Instant* at, const FootLoads& loads) const;
  double Limit(Side side, Eigen::Index joint) const;

  const MarginPlace& place_;
};

}  // namespace halfstep
