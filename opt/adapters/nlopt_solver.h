#pragma once

#include <memory>
#include <string>
#include <vector>

#include "opt/solvers/solver.h"

namespace halfstep::opt {

/// An algorithm of NLopt and which problems it accepts (NLopt 2.7.1; opt/README.md).
struct NloptMethod {
  std::string name;        ///< "nlopt/auglag_mma"
  std::string algorithm;   ///< NLopt's spelling: "LD_AUGLAG"
  std::string subsidiary;  ///< inner algorithm of an augmented Lagrangian: "LD_MMA"; else ""
  bool gradient;           ///< uses the gradient of cost and rows
  bool inequalities;       ///< takes rows l ≤ g(x) ≤ u with l < u
  bool equalities;         ///< takes rows with l = u
  bool finite_bounds;      ///< requires finite bounds on every variable
  int least_variables;     ///< fails below this number of variables
  /// What it is taken to do with a Jacobian (SolveMonitor::EstimateAlgebra): its dual problems and
  /// least squares go over it many times. Methods without derivatives count nothing.
  int passes;
};

/// All that the list of solvers offers.
const std::vector<NloptMethod>& NloptMethods();

/// Returns an UnavailableSolver when NLopt is not compiled in.
std::unique_ptr<Solver> MakeNloptSolver(const NloptMethod& method);

}  // namespace halfstep::opt
