#pragma once

#include <string>

#include "smoothing/margins/margin_statements.h"

namespace halfstep {

/// Distance of the ZMP inside the support polygon [m], negative outside. Subject: the step in the
/// air, or −1.
class ZmpMargin final : public WholeFamily {
 public:
  /// Of the family `zmp`.
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kZmp,
      .name = "zmp",
      .unit = "m",
      .key = "zmp_m",
      .meaning = "ZMP inside the support polygon",
      .remedy =
          "a longer `half_step.duration_s` (the shorter a half-step, the farther the ZMP leaves "
          "the soles)",
      .scale = 0.01,
      .demanded = 0.01,
      .raised = true,
      .cost = MarginCost::kWalk,
      .row = MarginFamily::kZmp,
  };

  /// Needs nothing of the place.
  explicit ZmpMargin(const MarginPlace&) : WholeFamily(kTraits) {}

  int count() const override;
  std::string Subject(const Margin& margin) const override;
  Margin Least(Instant* at, double enough) const override;
  void AddRows(Instant* at, SlackSink* rows) const override;

 protected:
  void AddBounds(const MarginInterval& interval, TightestStatement* tightest) const override;
};

}  // namespace halfstep
