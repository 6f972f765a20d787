#pragma once

#include <memory>

#include "opt/solvers/solver.h"

namespace halfstep::opt {

/// A feasible interior point method: once inside, every iterate keeps every inequality strictly, so
/// that it may be stopped anywhere. Newton steps on
///
///     f(x) − μ Σ log(slack of a row) − μ Σ log(distance to a bound),    μ → 0,
///
/// with primal-dual weights for the barrier, a limited-memory estimate of the Lagrangian's Hessian
/// and the exact sparse Jacobian; the sparse Cholesky factorization costs O(n) for banded rows.
/// From a start outside it first lowers the sum of the violations. Takes no equalities.
/// Source: opt/README.md, "halfstep/barrier"; [Nocedal2006], chapter 19.
std::unique_ptr<Solver> MakeBarrierSolver();

}  // namespace halfstep::opt
