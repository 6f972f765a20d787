#include "opt/adapters/ceres_solver.h"
#include "opt/adapters/unavailable_solver.h"

namespace halfstep::opt {

std::unique_ptr<Solver> MakeCeresSolver() {
  return std::make_unique<UnavailableSolver>("ceres/auglag", HALFSTEP_WHY_NO_CERES);
}

}  // namespace halfstep::opt
