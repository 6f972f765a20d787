#pragma once

#include <span>
#include <string_view>

#include "smoothing/methods/range_search.h"

namespace halfstep {

/// Where the rounds of a search begin.
enum class SearchStart {
  kTypical,    ///< each half-step in its typical form (TypicalStart)
  kDichotomy,  ///< at the dichotomy's walk
  kPlanned,    ///< at the planned motion
};

/// "typical" …
std::string_view Name(SearchStart start);

/// A part of a search: rounds in windows from the first half-step to the last, or over the whole
/// walk.
struct SearchStage {
  int window = 0;   ///< half-steps that are moved together; even, ≥ 2; 0: all
  int step = 0;     ///< half-steps by which the next window lies further on; even, 2 … window
  int passes = 1;   ///< over the walk at most; a later one takes windows near which something moved
  int rounds = 40;  ///< from each start at most
  /// Over the whole, with support points on which the robot could rest, until nearly all of an end
  /// is proved; a further start only where the one before led nowhere.
  bool resting = false;
};

/// Lowers the cost of the monitor's incumbent, which is proved, by one stage after the other, each
/// from where the one before has come to, until `effort` of the monitor is used. Over the whole,
/// rounds begin at `start`, then where all half-steps have the slowest typical form, then at the
/// incumbent as long as that gains. Gains are proved by the stretches that they change, and
/// adopted; what windows gained is proved again at its times in the walk. Returns whether a walk of
/// its own is the incumbent now. Source: smoothing/README.md, "The search".
bool RunStages(const WalkProblem& problem, std::span<const SearchStage> stages, SearchStart start,
               const RangeOptions& options, double effort, SmoothingMonitor& monitor,
               SearchEnding* ending);

/// Looks for a walk that is proved where the planned motion is not: rounds over the whole walk,
/// from each of RunStages' starts, until one is proved or `effort` of the monitor is used. It is
/// adopted, whatever it costs. Returns whether there is one.
bool FindFirst(const WalkProblem& problem, const RangeOptions& options, double effort,
               SmoothingMonitor& monitor, SearchEnding* ending);

}  // namespace halfstep
