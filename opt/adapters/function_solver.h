#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>

#include "opt/solvers/solve_monitor.h"
#include "opt/solvers/solver.h"

namespace halfstep::opt {

/// Goes from x0 (n), within the variables' bounds, to a better x (n). It evaluates the problem
/// through the monitor, which keeps the best point seen, or directly; it ends when the monitor's
/// functions return false.
using Minimize = std::function<Eigen::VectorXd(SolveMonitor& monitor, const Eigen::VectorXd& x0)>;

/// The solver that is this function. What it returns is evaluated and judged
/// as any solver's end.
std::unique_ptr<Solver> MakeFunctionSolver(const std::string& name, Minimize minimize);

}  // namespace halfstep::opt
