#pragma once

#include "smoothing/methods/smoothing_monitor.h"

namespace halfstep {

/// What no walk can be shorter than [s], in three parts that do not overlap in time.
struct LipmBound {
  double feet = 0.0;   ///< feet in the air: their ways, turns and limits of speed
  double first = 0.0;  ///< both feet standing before the first lift-off: the CoM has to be set off
  double last = 0.0;   ///< and after the last landing: it has to come to rest
  double total() const { return feet + first + last; }  ///< no walk on the footsteps is shorter [s]
};

/// A lower bound on the duration of every walk from rest to rest on the problem's footsteps in
/// which one foot at a time is in the air, within the limits of foot speed and yaw rate less what
/// is demanded of them, and above the floor by what is demanded while it moves horizontally, and in
/// which CoM and ZMP are those of a LIPM whose ZMP stays inside the soles that stand by what is
/// demanded. The ZMP's form, timing, joints, reach and obstacles are free, so every certified walk
/// of any method is one of these. Source: smoothing/README.md, "A lower bound".
/// Precondition: the problem's model is a Lipm (std::logic_error).
LipmBound LowerBound(const WalkProblem& problem);

/// The bound as a method, which finds no walk: it keeps the start and says the bound. Ending:
/// kNoImprovement, or kNotRun where the start is not feasible or the model is no LIPM.
SmoothingResult TellLipmBound(const WalkProblem& problem, SmoothingMonitor& monitor);

}  // namespace halfstep
