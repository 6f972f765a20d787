#pragma once

#include <memory>

#include "opt/solvers/solver.h"

namespace halfstep::opt {

/// Sequential quadratic programming in a trust region, with the exact penalty
///
///     φ(x) = f(x) + ν Σ violations
///
/// as its merit and the exact sparse Jacobian; one evaluation of derivatives an iteration, O(n) for
/// banded rows. Iterates keep the variables' bounds and may violate rows.
/// Source: opt/README.md, "halfstep/sqp"; [Nocedal2006], sections 18.5 and 18.8.
std::unique_ptr<Solver> MakeSqpSolver();

}  // namespace halfstep::opt
