#pragma once

#include <memory>

#include "opt/solvers/solver.h"

namespace halfstep::opt {

/// "ceres/auglag". Ceres supports neither inequalities nor, in its minimizer of general functions,
/// bounds: constraints enter by an augmented Lagrangian, bounds by a change of variables that keeps
/// every point between them (opt/README.md). Returns an UnavailableSolver when Ceres is not
/// compiled in.
std::unique_ptr<Solver> MakeCeresSolver();

}  // namespace halfstep::opt
