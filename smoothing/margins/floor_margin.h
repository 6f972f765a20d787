#pragma once

#include <string>

#include "smoothing/margins/margin_statements.h"

namespace halfstep {

/// Height of the swing sole above the floor while it moves horizontally [m]. Before its horizontal
/// motion begins and after it ends, the foot may touch the floor and the margin is +∞. Subject:
/// Index(Side).
class FloorMargin final : public WholeFamily {
 public:
  /// Of the family `floor`.
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kFloor,
      .name = "floor",
      .unit = "m",
      .key = "floor_m",
      .meaning = "height of the sole while it moves horizontally",
      .remedy = "a higher `half_step.via_height_m`, a longer `half_step.foot_delay`",
      .scale = 0.01,
      .demanded = 0.005,
      .raised = false,
      .cost = MarginCost::kWalk,
      .row = MarginFamily::kFloor,
  };

  /// Needs the height of the place's floor.
  explicit FloorMargin(const MarginPlace& place)
      : WholeFamily(kTraits), floor_(place.scene.ground->Floor()) {}

  int count() const override;
  std::string Subject(const Margin& margin) const override;
  Margin Least(Instant* at, double enough) const override;
  void AddRows(Instant* at, SlackSink* rows) const override;

 protected:
  void AddBounds(const MarginInterval& interval, TightestStatement* tightest) const override;

 private:
  double floor_;  // [m]
};

}  // namespace halfstep
