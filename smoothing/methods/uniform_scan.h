#pragma once

#include "smoothing/methods/smoothing_monitor.h"

namespace halfstep {

/// A grid of uniform factors. The planned motion, both factors 1, is always one of its points.
struct UniformScanOptions {
  bool heights = true;          ///< scan η; else it stays 1
  bool durations = true;        ///< scan T; else as planned
  double least_height = 0.3;    ///< η, ∈ (0, 1]
  double height_step = 0.1;     ///< of η, > 0: from 1 downwards
  double least_duration = 0.5;  ///< of the planned T, ∈ (0, 1]
  double most_duration = 1.2;   ///< of the planned T, ≥ 1
  double duration_step = 0.05;  ///< of the planned T, > 0: from 1 both ways
  double coarse = 0.02;         ///< tolerance of the dichotomy at every grid point [s] > 0
  int finalists = 3;            ///< ≥ 1: best points that are smoothed with the fine tolerance
  double fine = 0.001;          ///< [s] > 0
};

/// The fair baseline of a joint optimization: all durations times one factor and all heights times
/// another, then the dichotomy; the best of a grid. A grid point whose start is not feasible is
/// left out, even when smoothed walks with its durations and heights would be feasible.
/// kNotRun when no point of the grid is feasible. One iterate for each dichotomy.
/// Between grid points nothing is claimed.
SmoothingResult UniformScan(const WalkProblem& problem, const UniformScanOptions& options,
                            SmoothingMonitor& monitor);

}  // namespace halfstep
