#include "opt/adapters/solver_registry.h"

#include <stdexcept>

#include "opt/adapters/ceres_solver.h"
#include "opt/adapters/ipopt_solver.h"
#include "opt/adapters/nlopt_solver.h"
#include "opt/solvers/barrier_solver.h"
#include "opt/solvers/sqp_solver.h"

namespace halfstep::opt {

std::vector<std::string> SolverNames() {
  std::vector<std::string> names = {"ipopt"};
  for (const NloptMethod& method : NloptMethods()) names.push_back(method.name);
  names.push_back("ceres/auglag");
  names.push_back("halfstep/barrier");
  names.push_back("halfstep/sqp");
  return names;
}

std::unique_ptr<Solver> MakeSolver(const std::string& name) {
  if (name == "ipopt") return MakeIpoptSolver();
  if (name == "halfstep/barrier") return MakeBarrierSolver();
  if (name == "halfstep/sqp") return MakeSqpSolver();
  if (name == "ceres/auglag") return MakeCeresSolver();
  for (const NloptMethod& method : NloptMethods()) {
    if (method.name == name) return MakeNloptSolver(method);
  }
  std::string valid;
  for (const std::string& known : SolverNames()) valid += (valid.empty() ? "" : ", ") + known;
  throw std::invalid_argument("unknown solver `" + name + "` (valid: " + valid + ")");
}

}  // namespace halfstep::opt
