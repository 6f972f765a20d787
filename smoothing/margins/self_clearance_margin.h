#pragma once

#include <string>
#include <vector>

#include "smoothing/margins/margin_statements.h"

namespace halfstep {

/// Distance between two of the robot's own bodies [m], at most the clearance cap; −∞ when a leg
/// does not reach. Proved pair by pair. Subject and other: indices of RobotModel::bodies.
class SelfClearanceMargin final : public MarginStatements {
 public:
  /// Of the family `self_clearance`.
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kSelfClearance,
      .name = "self_clearance",
      .unit = "m",
      .key = "self_clearance_m",
      .meaning = "between the robot's own bodies",
      .remedy =
          "`excluded_self_pairs` of the robot file if these links touch by design, another "
          "`standing_posture_deg`, or a foot that passes farther aside (`half_step.via_lateral_m`)",
      .scale = 0.01,
      .demanded = 0.005,
      .raised = true,
      .cost = MarginCost::kPairs,
      .row = MarginFamily::kSelfClearance,
  };

  /// `place` is borrowed.
  explicit SelfClearanceMargin(const MarginPlace& place)
      : MarginStatements(kTraits), place_(place) {}

  int count() const override;
  std::string Subject(const Margin& margin) const override;
  Margin Least(Instant* at, double enough) const override;
  std::optional<Margin> FirstBelow(Instant* at, double demanded) const override;
  void AddBelow(Instant* at, double demanded, std::vector<Margin>* below) const override;
  void AddRows(Instant* at, SlackSink* rows) const override;
  int groups() const override { return count(); }
  Margin OfGroup(uint16_t group) const override;
  FamilyProof Prove(const MarginInterval& interval, std::vector<uint16_t>* open) const override;

 private:
  const MarginPlace& place_;
};

}  // namespace halfstep
