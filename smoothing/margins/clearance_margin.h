#pragma once

#include <string>
#include <vector>

#include "smoothing/margins/margin_statements.h"

namespace halfstep {

/// Distance from a body of the robot to the obstacles where they are said to be at that time, less
/// how far from there they may be [m]; at most the clearance cap; −∞ when a leg does not reach.
/// Proved body by body: over an interval each obstacle takes off its own speed times the half
/// width. Subject: index of RobotModel::bodies. Other: the obstacle.
class ClearanceMargin final : public MarginStatements {
 public:
  /// Of the family `clearance`.
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kClearance,
      .name = "clearance",
      .unit = "m",
      .key = "clearance_m",
      .meaning = "robot to obstacles",
      .remedy = "a higher `half_step.via_height_m`, other footsteps, an obstacle elsewhere",
      .scale = 0.01,
      .demanded = 0.005,
      .raised = true,
      .cost = MarginCost::kObstacles,
      .row = MarginFamily::kClearance,
  };

  /// `place` is borrowed.
  explicit ClearanceMargin(const MarginPlace& place) : MarginStatements(kTraits), place_(place) {}

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
