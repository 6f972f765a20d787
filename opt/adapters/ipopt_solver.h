#pragma once

#include <memory>

#include "opt/solvers/solver.h"

namespace halfstep::opt {

/// Ipopt: interior point with the exact sparse Jacobian and a limited-memory Hessian. Returns an
/// UnavailableSolver when it is not compiled in.
std::unique_ptr<Solver> MakeIpoptSolver();

}  // namespace halfstep::opt
