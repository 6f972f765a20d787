#include <cmath>

#include "smoothing/margins/family_class.h"
#include "wpg/elementary.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// Distance of a standing foot from the no-step areas [m], by the outline of what touches the floor
// (NoStepAreas); +∞ for a foot in the air, and without areas. There are rows where footsteps move
// (SlackSink::footsteps_move). Subject: Index(Side). Other: the area.
class NoStepMargin final : public WholeFamily {
 public:
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kNoStep,
      .name = "no_step",
      .unit = "m",
      .key = "no_step_m",
      .meaning = "standing sole to no-step areas; touching is never allowed",
      .remedy = "other footsteps",
      .sentence = kOfALimit,
      .coverage = kAlwaysCovered,
      .scope = MarginScope::kScene,
      .scale = 0.01,
      .demanded = 0.0,
      .raised = false,
      .cost = MarginCost::kWalk,
      .row = MarginFamily::kFloor,
      .in_tube = [](const TubeShift& shift) { return shift.sole; },
  };

  explicit NoStepMargin(const MarginPlace& place) : WholeFamily(kTraits), place_(place) {}

  int count() const override { return 2; }

  std::string Subject(const Margin& margin) const override {
    if (margin.subject < 0) return "both feet";
    const std::string foot = FootName(margin);
    // As the scene file counts them.
    return margin.other < 0 ? foot : foot + " - no_step[" + std::to_string(margin.other) + "]";
  }

  std::vector<Side> PlacedFeet(const Margin& margin) const override {
    if (margin.subject < 0) return {};
    return {static_cast<Side>(margin.subject)};
  }

  Margin Least(Instant* at, double) const override {
    Margin least = Of(kUnlimited, -1);
    for (Side side : {Side::kLeft, Side::kRight}) Lower(OfSole(*at, side), &least);
    return least;
  }

  void AddRows(Instant* at, SlackSink* rows) const override {
    if (!rows->footsteps_move || place_.areas.empty()) return;
    // The distance of two polygons is smooth but where another pair of features becomes the
    // nearest, so differences tell its slope to some nine digits.
    constexpr double kStep = 1e-6;
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const Margin margin = OfSole(*at, side);
      if (std::isinf(margin.value)) continue;
      rows->AddAlong(margin.value, [&](size_t i) {
        const WalkState& x = at->jet().value;
        const WalkState move = kStep * rows->sensitivities[i].jet.value;
        return (place_.areas.NearestTo(FootPose(x + move, side)).distance -
                place_.areas.NearestTo(FootPose(x - move, side)).distance) /
               (2.0 * kStep);
      });
    }
  }

 protected:
  void AddBounds(const MarginInterval& interval, TightestStatement* tightest) const override {
    for (Side side : {Side::kLeft, Side::kRight}) {
      // A sole that stands does not move: its quantities change by 0 and rounding.
      const int foot = FootIndex(side);
      const IntervalMotion& motion = interval.motion;
      const double moved = Hypot(motion.Change(foot), motion.Change(foot + 1)) +
                           place_.areas.sole_reach() * motion.Change(foot + 3);
      const Margin margin = OfSole(interval.mid, side);
      tightest->Add(margin, (std::isinf(margin.value) ? 0.0 : moved) + interval.mid.rounding());
    }
  }

 private:
  // +∞ while it is in the air, or where there are no areas.
  Margin OfSole(const Instant& at, Side side) const {
    Margin margin = Of(kUnlimited, Index(side));
    if (place_.areas.empty() || at.walk().InAir(at.at(), side)) return margin;
    MarginScratch::Standing& standing = Nth(at.scratch().standing, Index(side));
    const Pose2 X_WF = FootPose(at.jet().value, side);
    if (!standing.known || standing.X_WF != X_WF) {
      standing = {X_WF, place_.areas.NearestTo(X_WF), true};
    }
    margin.value = standing.nearest.distance;
    margin.other = standing.nearest.area;
    return margin;
  }

  const MarginPlace& place_;
};

}  // namespace

const FamilyClass& ClassOf(TagOf<NoStepMargin>) { return kClassOf<NoStepMargin>; }

}  // namespace halfstep
