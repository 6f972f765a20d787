#pragma once

#include <string>

#include "opt/solvers/solution.h"

namespace halfstep {

class SmoothingMonitor;

/// What is known when a search by a solver, in rounds from several starts, is over.
struct SearchEnding {
  std::string solver;                      ///< by its name
  opt::Ending cut = opt::Ending::kNotRun;  ///< what cut it off; kNotRun: nothing
  std::string why_cut = {};                ///< the same in words
  bool exhausted = false;                  ///< all rounds from a start were used
  bool called = false;                     ///< the solver, at least once
  bool all_failed = true;                  ///< every solve ended kFailed
  bool own = false;  ///< the result comes from the search, and beats what it began with
  opt::Ending last_ending = opt::Ending::kNotRun;  ///< of the last solve
  std::string last_message = {};                   ///< the solver's own words about the last solve
  /// The last solve saw no point that violates less than this (of a slack's scale), and where; 0:
  /// it violates so little that it may be worth a proof.
  double last_violation = 0.0;
  std::string last_violated = {};  ///< name of the row or variable
  /// What the result is when it does not come from the search: "the walk is a dichotomy's".
  std::string kept = {};

  void Note(const opt::Solution& solution);  ///< takes note of a solve
  /// Takes note that the search is to end: by the caller, by the clock or because its effort is
  /// used.
  void NoteCut(const SmoothingMonitor& monitor);

  /// How the whole search ended, as in SmoothingResult::ending.
  opt::Ending Ending() const;
  /// What ended the search, and how the last solve ended.
  std::string Sentence() const;
};

}  // namespace halfstep
