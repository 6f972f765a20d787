#pragma once

#include <memory>
#include <string>
#include <vector>

#include "opt/solvers/solver.h"

namespace halfstep::opt {

/// Names of all solvers, compiled into this build or not: "ipopt", "nlopt/ccsaq", …,
/// "ceres/auglag", "halfstep/sqp".
std::vector<std::string> SolverNames();

/// Makes the solver of that name. Throws std::invalid_argument, which lists the known names, for an
/// unknown one.
std::unique_ptr<Solver> MakeSolver(const std::string& name);

}  // namespace halfstep::opt
