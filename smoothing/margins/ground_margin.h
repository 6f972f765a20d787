#pragma once

#include <string>

#include "smoothing/margins/margin_statements.h"

namespace halfstep {

/// Height of a body's lowest point above the floor [m]; −∞ when a leg does not reach. A body on a
/// foot may touch the floor (BodyHeights). Subject: index of RobotModel::bodies.
class GroundMargin final : public WholeFamily {
 public:
  /// Of the family `ground`.
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kGround,
      .name = "ground",
      .unit = "m",
      .key = "ground_m",
      .meaning = "lowest point of a body above the floor; feet may touch it",
      .remedy =
          "a higher `half_step.via_height_m`, or knees that are bent less (`standing_posture_deg` "
          "of the robot file)",
      .scale = 0.01,
      .demanded = 0.0,
      .raised = false,
      .cost = MarginCost::kJointSpeeds,
      .row = MarginFamily::kFloor,
  };

  /// `place` is borrowed.
  explicit GroundMargin(const MarginPlace& place) : WholeFamily(kTraits), place_(place) {}

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
