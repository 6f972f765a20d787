#pragma once

#include "smoothing/methods/walk_problem.h"
#include "smoothing/walk/homotopy_parameters.h"

namespace halfstep {

/// Some half-steps of a walk that a method may change while all others stay, and a part of the walk
/// that holds all on which these bear. The part is a problem of its own, so what it costs to work
/// on does not grow with the walk. Among obstacles that move it is the whole walk.
///
/// What the walk does on the stretches [t_k, t_{k+1}] of the half-steps `proved_first` …
/// `proved_last`, counted in the part, is what the part does there, though at other times; no other
/// stretch of the walk changes with the part. Source: smoothing/README.md, "Windows".
struct WalkWindow {
  int begin = 0;                          ///< the part's first half-step, counted in the walk; even
  int proved_first = 0, proved_last = 0;  ///< first and last stretch for which that holds
  HomotopyParameters parameters;          ///< the walk's, of the part
  /// The part, with the test of the walk, which is borrowed. Fixed are the parameters that are to
  /// stay, at their values in the walk.
  WalkProblem problem;

  /// The part's parameters of those of the walk.
  HomotopyParameters Cut(const HomotopyParameters& walk) const;
  /// Puts parameters of the part into those of the walk.
  void Paste(const HomotopyParameters& part, HomotopyParameters* walk) const;
};

/// The window of the half-steps first … last of the walk `at`: parameters of every family may
/// change that belong to none but these, and the overlap before `first`; but nothing that `problem`
/// fixes. A duration stays, too, beside an overlap that stays and is longer than the planned
/// durations allow. Precondition (std::logic_error): first is even, last is odd, and they are
/// half-steps of the problem.
WalkWindow WindowOf(const WalkProblem& problem, const HomotopyParameters& at, int first, int last);

}  // namespace halfstep
