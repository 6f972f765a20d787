#include "smoothing/margins/no_step_margin.h"

#include <cmath>
#include <limits>

#include "wpg/nth.h"

namespace halfstep {

int NoStepMargin::count() const { return 2; }

std::string NoStepMargin::Subject(const Margin& margin) const {
  if (margin.subject < 0) return "both feet";
  const std::string foot = FootName(margin);
  // As the scene file counts them.
  return margin.other < 0 ? foot : foot + " - no_step[" + std::to_string(margin.other) + "]";
}

Margin NoStepMargin::OfSole(const Instant& at, Side side) const {
  Margin margin = Of(std::numeric_limits<double>::infinity(), Index(side));
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

Margin NoStepMargin::Least(Instant* at, double) const {
  Margin least = Of(std::numeric_limits<double>::infinity(), -1);
  for (Side side : {Side::kLeft, Side::kRight}) Lower(OfSole(*at, side), &least);
  return least;
}

void NoStepMargin::AddRows(Instant* at, SlackSink* rows) const {
  if (!rows->footsteps_move || place_.areas.empty()) return;
  // The distance of two polygons is smooth but where another pair of features becomes the nearest,
  // so differences tell its slope to some nine digits.
  constexpr double kStep = 1e-6;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Margin margin = OfSole(*at, side);
    if (std::isinf(margin.value)) continue;
    rows->Add(margin.value, [&](size_t i) {
      const WalkState& x = at->jet().value;
      const WalkState move = kStep * rows->sensitivities[i].jet.value;
      return (place_.areas.NearestTo(FootPose(x + move, side)).distance -
              place_.areas.NearestTo(FootPose(x - move, side)).distance) /
             (2.0 * kStep);
    });
  }
}

void NoStepMargin::AddBounds(const MarginInterval& interval, TightestStatement* tightest) const {
  for (Side side : {Side::kLeft, Side::kRight}) {
    // A sole that stands does not move: its quantities change by 0 and rounding.
    const int foot = FootIndex(side);
    const IntervalMotion& motion = interval.motion;
    const double moved = std::hypot(motion.Change(foot), motion.Change(foot + 1)) +
                         place_.areas.sole_reach() * motion.Change(foot + 3);
    const Margin margin = OfSole(interval.mid, side);
    tightest->Add(margin, (std::isinf(margin.value) ? 0.0 : moved) + interval.mid.rounding());
  }
}

}  // namespace halfstep
