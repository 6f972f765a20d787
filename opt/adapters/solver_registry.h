#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "opt/solvers/solver.h"

namespace halfstep::opt {

/// Names of all solvers, compiled into this build or not: "ipopt", "nlopt/ccsaq", …,
/// "ceres/auglag"; those that were registered come last.
std::vector<std::string> SolverNames();

/// Makes the solver of that name. Throws std::invalid_argument, which lists the known names, for an
/// unknown one.
std::unique_ptr<Solver> MakeSolver(const std::string& name);

/// Makes a solver of one's own known by the name that `make()->name()` has, in place of an earlier
/// one of that name: a method of smoothing by that name, too. Throws std::invalid_argument for the
/// name of a solver that is built in. Before it is used, and not while another thread smooths.
void RegisterSolver(std::function<std::unique_ptr<Solver>()> make);

}  // namespace halfstep::opt
