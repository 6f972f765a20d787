#include "opt/adapters/nlopt_solver.h"
#include "opt/adapters/unavailable_solver.h"

namespace halfstep::opt {

std::unique_ptr<Solver> MakeNloptSolver(const NloptMethod& method) {
  return std::make_unique<UnavailableSolver>(method.name, HALFSTEP_WHY_NO_NLOPT);
}

}  // namespace halfstep::opt
