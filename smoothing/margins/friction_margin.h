#pragma once

#include <string>

#include "smoothing/margins/margin_statements.h"

namespace halfstep {

/// The floor's friction coefficient (Scene::friction) less the one that the soles need so as not to
/// slip or turn, from the whole robot's dynamics. Needed is what suffices for a pressure of two
/// points of the support polygon, as far before the ZMP as behind it: (‖f_t‖ + |n_z|/ρ)/f_z with
/// the floor's tangential force f_t [N], its yaw moment n_z about the ZMP [N m], its push f_z [N]
/// and the distance ρ of the points from the ZMP [m]. −∞ when a leg does not reach or is stretched
/// to the singularity, masses are not known, the floor does not push, or the ZMP is outside.
/// Subject: the step in the air, or −1. Where nothing is demanded (kNotDemanded) it has no rows,
/// and its proofs say nothing. Source: wpg/README.md, "Friction that is needed"; [Caron2015].
class FrictionMargin final : public WholeFamily {
 public:
  /// Of the family `friction`.
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kFriction,
      .name = "friction",
      .unit = "1",
      .key = "friction",
      .meaning =
          "friction coefficient of the scene less what the soles need, yaw moment included; "
          "none: not demanded",
      .remedy =
          "a longer `half_step.duration_s`, a lower `half_step.via_height_m` (the swing leg's "
          "momentum turns the support foot)",
      .scale = 0.05,
      .demanded = 0.0,
      .raised = true,
      .cost = MarginCost::kJointSpeeds,
      .row = MarginFamily::kFriction,
      .may_be_none = true,
  };

  /// `place` is borrowed.
  explicit FrictionMargin(const MarginPlace& place) : WholeFamily(kTraits), place_(place) {}

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
