#pragma once

#include <limits>
#include <vector>

#include "wpg/geometry/foothold.h"
#include "wpg/geometry/side.h"

namespace halfstep {

/// Times of a walk [s], both ends included.
struct TimeInterval {
  double begin = 0.0;                                    ///< [s] ≥ 0
  double end = std::numeric_limits<double>::infinity();  ///< [s] ≥ begin
  /// Whether t [s] is one of them.
  bool Contains(double t) const { return begin <= t && t <= end; }
};
/// In the order of time; no two have a time in common.
using TimeIntervals = std::vector<TimeInterval>;

/// The times that two intervals have in common; none: begin > end.
inline TimeInterval Common(const TimeInterval& a, const TimeInterval& b) {
  return {a.begin > b.begin ? a.begin : b.begin, a.end < b.end ? a.end : b.end};
}

/// The interval that contains t [s]; null: none does.
inline const TimeInterval* IntervalAt(const TimeIntervals& intervals, double t) {
  for (const TimeInterval& interval : intervals) {
    if (interval.Contains(t)) return &interval;
  }
  return nullptr;
}

/// Answers when a half-step of a StepSet, placed in the world, is free of all that moves there, and
/// when the robot may rest before and after it. Each interval is proved for all of its times;
/// times in doubt are in none. An answer is complete for the times of `within`. Of other times it
/// may hold some, all, or none. What rests is asked of a HalfStepQuery. Const and thread-safe.
/// Source: planner/README.md, "Planning in time"; safe intervals after [Phillips2011].
class HalfStepTimes {
 public:
  virtual ~HalfStepTimes() = default;

  /// When the down half-step of element i on `support`, whose sole stands at X_WS, may begin; it
  /// lands at X_WF.
  virtual TimeIntervals DownStarts(int i, Side support, const Foothold& X_WS, const Foothold& X_WF,
                                   const TimeInterval& within) const = 0;
  /// When the up half-step that follows it may begin.
  virtual TimeIntervals UpStarts(int i, Side support, const Foothold& X_WS, const Foothold& X_WF,
                                 const TimeInterval& within) const = 0;
  /// When the robot may rest between the two, on both feet.
  virtual TimeIntervals OnBothFeet(int i, Side support, const Foothold& X_WS, const Foothold& X_WF,
                                   const TimeInterval& within) const = 0;
  /// When it may rest on the foot `support`, which stands at X_WS, with the other at its via point.
  virtual TimeIntervals OnOneFoot(Side support, const Foothold& X_WS,
                                  const TimeInterval& within) const = 0;
  /// From then on nothing that it knows moves [s], or it knows of no time that is later.
  virtual double settled() const = 0;
  /// Work of the answers so far, in the unit of PlanProgress::effort.
  virtual double effort() const { return 0.0; }
};

}  // namespace halfstep
