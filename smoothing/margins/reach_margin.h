#pragma once

#include <string>

#include "smoothing/margins/margin_statements.h"

namespace halfstep {

/// Length of the stretched leg − hip–ankle distance [m] (LegIkSolution::reach_margin). Subject:
/// 6·Index(Side) + 3, the knee.
class ReachMargin final : public WholeFamily {
 public:
  /// Of the family `reach`.
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kReach,
      .name = "reach",
      .unit = "m",
      .key = "reach_m",
      .meaning = "leg shorter than stretched",
      .remedy =
          "shorter steps, a lower `half_step.via_height_m`, or knees that are bent more "
          "(`standing_posture_deg` of the robot file)",
      .scale = 0.01,
      .demanded = 0.0,
      .raised = false,
      .cost = MarginCost::kPosture,
      .row = MarginFamily::kReach,
  };

  /// Needs nothing of the place.
  explicit ReachMargin(const MarginPlace&) : WholeFamily(kTraits) {}

  int count() const override;
  std::string Subject(const Margin& margin) const override;
  Margin Least(Instant* at, double enough) const override;
  void AddRows(Instant* at, SlackSink* rows) const override;

 protected:
  void AddBounds(const MarginInterval& interval, TightestStatement* tightest) const override;
};

}  // namespace halfstep
