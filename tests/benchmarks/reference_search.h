#pragma once

#include <vector>

#include "smoothing/methods/smoothing_monitor.h"

namespace halfstep {

/// Options of ReferenceSearch.
struct ReferenceOptions {
  ParameterChoice parameters;  ///< searched beside the overlaps
  double period = 0.01;        ///< between the instants at which the grid is checked [s] > 0
  /// When overlaps alone are searched: number of values of each, from 0 to the natural bound, that
  /// are tried in every combination before the corridor; 0: no such round. Work grows with its
  /// fourth power.
  int global_values = 10;
  double widest = 0.1;       ///< first step of the corridor: Δ [s], T and η relative
  double narrowest = 0.002;  ///< the corridor ends when its step is smaller
  int choices = 3;           ///< ≥ 2: of each half-step in the corridor when η or T are searched
  int patience = 3;          ///< ≥ 1: rounds without gain before the step is halved
  unsigned seed = 1;         ///< of the corridor's directions when η or T are searched
  int max_rounds = 400;      ///< of each corridor
  /// Further points to begin at, besides the dichotomy's result; infeasible ones are left out.
  std::vector<HomotopyParameters> starts = {};
};

/// A reference for other methods: dynamic programming over a grid of parameters (DynamicProgram),
/// first over the whole range of the overlaps, when they are all that is searched, then from each
/// start in a corridor about the incumbent, whose step shrinks while nothing is gained. With
/// overlaps alone each has five values there and every combination counts; otherwise each half-step
/// chooses among the incumbent's (Δ, T, η) and random neighbours of it, so chains of
/// half-steps move together.
///
/// The grid is sampled. Every incumbent was found feasible by the problem's test: a grid's optimum
/// that it refuses is approached as an Incumbent does. It is no proof of optimality: the corridor
/// ends where no combination of its choices is shorter. Slow; endings as for Dichotomy; the message
/// says the resolution. One iterate for each round.
SmoothingResult ReferenceSearch(const WalkProblem& problem, const ReferenceOptions& options,
                                SmoothingMonitor& monitor);

}  // namespace halfstep
