#pragma once

#include <functional>
#include <optional>

#include "opt/solvers/solver.h"
#include "smoothing/methods/search_ending.h"
#include "smoothing/methods/smoothing_monitor.h"
#include "smoothing/methods/walk_window.h"
#include "smoothing/program/overlap_program.h"

namespace halfstep {

/// Options of SearchWindow.
struct WindowSearchOptions {
  ProgramOptions program;  ///< `fastest` or `smooth`
  /// What is tried first and where the first round begins, feasible or not, but for what the window
  /// fixes; none: the window's own parameters.
  std::optional<HomotopyParameters> start = std::nullopt;
  int rounds = 8;  ///< ≥ 1: most solves; the program is refined between them
  /// Where this is more than `rounds`, further solves follow up to this number, as long as the end
  /// of each costs at least 1 % less than the end before it.
  int most_rounds = 0;
};

/// Called with every new point of a window's part that was proved, and what it costs less than the
/// window's own parameters [s].
using WindowGain = std::function<void(const HomotopyParameters& part, double gain)>;

/// Lowers the cost of a window by a program over what is free in it, in rounds as OptimizeOverlaps
/// does, until two rounds in a row gain next to nothing. The window's own parameters must be proved
/// on the stretches that it may change; all that `gained` is called with is. `ending` notes how the
/// solves ended. Stops between rounds when the monitor is to stop or `deadline` [s] of its clock
/// has passed.
void SearchWindow(const WalkWindow& window, const WindowSearchOptions& options,
                  const opt::Solver& solver, double deadline, SmoothingMonitor& monitor,
                  const WindowGain& gained, SearchEnding* ending);

}  // namespace halfstep
