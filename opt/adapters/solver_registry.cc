#include "opt/adapters/solver_registry.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "opt/adapters/ceres_solver.h"
#include "opt/adapters/ipopt_solver.h"
#include "opt/adapters/nlopt_solver.h"
#include "opt/solvers/barrier_solver.h"
#include "opt/solvers/sqp_solver.h"

namespace halfstep::opt {
namespace {

struct RegisteredSolver {
  std::string name;
  std::function<std::unique_ptr<Solver>()> make;
};

std::vector<RegisteredSolver>& RegisteredSolvers() {
  static std::vector<RegisteredSolver> solvers;
  return solvers;
}

std::vector<std::string> BuiltInNames() {
  std::vector<std::string> names = {"ipopt"};
  for (const NloptMethod& method : NloptMethods()) names.push_back(method.name);
  names.push_back("ceres/auglag");
  names.push_back("halfstep/barrier");
  names.push_back("halfstep/sqp");
  return names;
}

}  // namespace

std::vector<std::string> SolverNames() {
  std::vector<std::string> names = BuiltInNames();
  for (const RegisteredSolver& own : RegisteredSolvers()) names.push_back(own.name);
  return names;
}

void RegisterSolver(std::function<std::unique_ptr<Solver>()> make) {
  RegisteredSolver own{.name = make()->name(), .make = std::move(make)};
  if (std::ranges::count(BuiltInNames(), own.name) > 0) {
    throw std::invalid_argument("solver `" + own.name + "` is built in");
  }
  auto& all = RegisteredSolvers();
  const auto same = std::ranges::find(all, own.name, &RegisteredSolver::name);
  if (same != all.end()) {
    *same = std::move(own);
  } else {
    all.push_back(std::move(own));
  }
}

std::unique_ptr<Solver> MakeSolver(const std::string& name) {
  if (name == "ipopt") return MakeIpoptSolver();
  if (name == "halfstep/barrier") return MakeBarrierSolver();
  if (name == "halfstep/sqp") return MakeSqpSolver();
  if (name == "ceres/auglag") return MakeCeresSolver();
  for (const NloptMethod& method : NloptMethods()) {
    if (method.name == name) return MakeNloptSolver(method);
  }
  for (const RegisteredSolver& own : RegisteredSolvers()) {
    if (own.name == name) return own.make();
  }
  std::string valid;
  for (const std::string& known : SolverNames()) valid += (valid.empty() ? "" : ", ") + known;
  throw std::invalid_argument("unknown solver `" + name + "` (valid: " + valid + ")");
}

}  // namespace halfstep::opt
