#pragma once

#include <optional>
#include <string>
#include <vector>

#include "opt/solvers/solve_monitor.h"

namespace halfstep::opt {

/// An option of one of our own solvers: a number above 0, or an integer from 0 to 1000.
struct OwnOption {
  std::string name;  ///< as in SolverOptions::solver_options
  bool integer;      ///< else a number above 0
  double value;      ///< the default; ReadOwnOptions replaces it
};

/// Reads SolverOptions::solver_options into `known` and records in the monitor what was used.
/// Returns an ending, kInvalidInput, when an option is unknown or out of range.
std::optional<SolverEnd> ReadOwnOptions(const std::string& solver, SolveMonitor* monitor,
                                        std::vector<OwnOption>* known);

}  // namespace halfstep::opt
