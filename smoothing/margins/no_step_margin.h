#pragma once

#include <string>

#include "smoothing/margins/margin_statements.h"

namespace halfstep {

/// Distance of a standing foot from the no-step areas [m], by the outline of what touches the floor
/// (NoStepAreas); +∞ for a foot in the air, and without areas. There are rows where footsteps move
/// (SlackSink::footsteps_move). Subject: Index(Side). Other: the area.
class NoStepMargin final : public WholeFamily {
  /// Of the family `no_step`.
 public:
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kNoStep,
      .name = "no_step",
      .unit = "m",
      .key = "no_step_m",
      .meaning = "standing sole to no-step areas; touching is never allowed",
      .remedy = "other footsteps",
      .scale = 0.01,
      .demanded = 0.0,
      .raised = false,
      .cost = MarginCost::kWalk,
      .row = MarginFamily::kFloor,
  };

  /// `place` is borrowed.
  explicit NoStepMargin(const MarginPlace& place) : WholeFamily(kTraits), place_(place) {}

  int count() const override;
  std::string Subject(const Margin& margin) const override;
  Margin Least(Instant* at, double enough) const override;
  void AddRows(Instant* at, SlackSink* rows) const override;

 protected:
  void AddBounds(const MarginInterval& interval, TightestStatement* tightest) const override;

 private:
  // Of one sole: +∞ while it is in the air, or where there are no areas.
  Margin OfSole(const Instant& at, Side side) const;

  const MarginPlace& place_;
};

}  // namespace halfstep
