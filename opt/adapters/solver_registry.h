#pragma once

#include <memory>
#include <string>
#include <vector>

#include "opt/solvers/solver.h"

namespace halfstep::opt {

/// Every solver there is, available or not: "ipopt", "nlopt/ccsaq", …, "ceres/auglag".
std::vector<std::string> SolverNames();

/// An unknown name is a std::invalid_argument that lists the known ones.
std::unique_ptr<Solver> MakeSolver(const std::string& name);

}  // namespace halfstep::opt
