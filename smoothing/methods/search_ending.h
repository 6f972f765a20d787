#pragma once

#include <string>

#include "opt/solvers/solution.h"

namespace halfstep {

/// What is known when a search by a solver, in rounds from several starts, is over.
struct SearchEnding {
  std::string solver;
  bool stopped = false;          ///< from outside
  bool deadline_passed = false;  ///< before all rounds were done
  bool exhausted = false;        ///< all rounds from a start were used
  bool called = false;           ///< the solver, at least once
  bool all_failed = true;        ///< every solve ended kFailed
  bool own = false;              ///< the result comes from the search, and beats what it began with
  opt::Ending last_ending = opt::Ending::kNotRun;  ///< of the last solve
  std::string last_message = {};
  /// What the result is when it does not come from the search: "the walk is a dichotomy's".
  std::string kept = {};

  void Note(const opt::Solution& solution);
  bool past_deadline() const { return deadline_passed || last_ending == opt::Ending::kDeadline; }

  /// How the whole search ended, as in SmoothingResult::ending.
  opt::Ending Ending() const;
  /// What ended the search, and how the last solve ended.
  std::string Sentence() const;
};

}  // namespace halfstep
