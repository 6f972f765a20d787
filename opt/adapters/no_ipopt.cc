#include "opt/adapters/ipopt_solver.h"
#include "opt/adapters/unavailable_solver.h"

namespace halfstep::opt {

std::unique_ptr<Solver> MakeIpoptSolver() {
  return std::make_unique<UnavailableSolver>("ipopt", HALFSTEP_WHY_NO_IPOPT);
}

}  // namespace halfstep::opt
