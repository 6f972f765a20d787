#pragma once

#include <string>

#include "smoothing/methods/method_options.h"
#include "smoothing/methods/window_passes.h"

namespace halfstep {

/// Options of `halfstep/horizon`. Its program is not `safest`, whose least slack belongs to the
/// whole walk; its deadline is that of all passes together.
struct HorizonOptions : WindowPassesOptions {
  std::string solver = "halfstep/sqp";  ///< one of opt::SolverNames()
  double tolerance = 0.001;             ///< of the dichotomies after the passes [s]
};

/// `smoothing.horizon`: window, step and passes; the rest is of `smoothing.optimizer`.
OptionGroup<HorizonOptions> HorizonGroup();
/// Declares its keys.
void DeclareFields(Fields& fields, HorizonOptions* options);

/// Smooths a walk of any length by programs over short windows of it, from the first half-step to
/// the last, again and again until nothing is gained:
///   1. the planned motion is the first incumbent, and a coarse dichotomy lengthens its overlaps;
///   2. in each pass, each window is lowered by SearchWindow. What is not in the window stays, so
///      the walk behind the windows of the first pass is as the dichotomy left it. A later pass
///      takes only windows near which the one before gained something;
///   3. `fastest`: a fine dichotomy from the incumbent, and one from the planned motion; the
///      shorter walk counts.
/// A gain in a window is proved by the stretches that it changes, and is kept whatever becomes of
/// other windows. Time and memory grow linearly with the walk, but among obstacles that move, where
/// all that comes later is looked at again. Ending and message as of OptimizeOverlaps.
/// Source: smoothing/README.md, "Windows".
SmoothingResult Horizon(const WalkProblem& problem, const HorizonOptions& options,
                        SmoothingMonitor& monitor);

}  // namespace halfstep
