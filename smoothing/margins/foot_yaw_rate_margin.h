#pragma once

#include <string>

#include "smoothing/margins/margin_statements.h"

namespace halfstep {

/// Limit − |yaw rate| of the swing sole [rad/s]; +∞ without a limit and while both feet stand.
/// Subject: Index(Side).
class FootYawRateMargin final : public WholeFamily {
 public:
  /// Of the family `foot_yaw_rate`.
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kFootYawRate,
      .name = "foot_yaw_rate",
      .unit = "rad/s",
      .key = "foot_yaw_rate_rad_s",
      .meaning = "inside the foot yaw rate limit",
      .remedy = "a longer `half_step.duration_s`, steps that turn less",
      .scale = 0.2,
      .demanded = 0.0,
      .raised = false,
      .cost = MarginCost::kWalk,
      .row = MarginFamily::kFootYawRate,
  };

  /// Needs nothing of the place.
  explicit FootYawRateMargin(const MarginPlace&) : WholeFamily(kTraits) {}

  int count() const override;
  std::string Subject(const Margin& margin) const override;
  Margin Least(Instant* at, double enough) const override;
  void AddRows(Instant* at, SlackSink* rows) const override;

 protected:
  void AddBounds(const MarginInterval& interval, TightestStatement* tightest) const override;
};

}  // namespace halfstep
