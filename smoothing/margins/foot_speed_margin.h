#pragma once

#include <string>

#include "smoothing/margins/margin_statements.h"

namespace halfstep {

/// Limit − speed of the swing sole's centre [m/s]; +∞ without a limit and while both feet stand.
/// Subject: Index(Side).
class FootSpeedMargin final : public WholeFamily {
 public:
  /// Of the family `foot_speed`.
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kFootSpeed,
      .name = "foot_speed",
      .unit = "m/s",
      .key = "foot_speed_m_s",
      .meaning = "inside the foot speed limit",
      .remedy = "a longer `half_step.duration_s`, shorter steps",
      .scale = 0.1,
      .demanded = 0.0,
      .raised = true,
      .cost = MarginCost::kWalk,
      .row = MarginFamily::kFootSpeed,
  };

  /// Needs nothing of the place.
  explicit FootSpeedMargin(const MarginPlace&) : WholeFamily(kTraits) {}

  int count() const override;
  std::string Subject(const Margin& margin) const override;
  Margin Least(Instant* at, double enough) const override;
  void AddRows(Instant* at, SlackSink* rows) const override;

 protected:
  void AddBounds(const MarginInterval& interval, TightestStatement* tightest) const override;
};

}  // namespace halfstep
