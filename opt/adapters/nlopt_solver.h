#pragma once

#include <memory>
#include <string>
#include <vector>

#include "opt/solvers/solver.h"

namespace halfstep::opt {

/// An algorithm of NLopt and what it can take (NLopt 2.7.1; opt/README.md).
struct NloptMethod {
  std::string name;        ///< "nlopt/auglag_mma"
  std::string algorithm;   ///< NLopt's spelling: "LD_AUGLAG"
  std::string subsidiary;  ///< of an augmented Lagrangian: "LD_MMA"; "" otherwise
  bool gradient;
  bool inequalities;
  bool equalities;
  bool finite_bounds;  ///< needs them on every variable
  int least_variables;
};

const std::vector<NloptMethod>& NloptMethods();

/// Unavailable, with the reason, when NLopt is not compiled in.
std::unique_ptr<Solver> MakeNloptSolver(const NloptMethod& method);

}  // namespace halfstep::opt
