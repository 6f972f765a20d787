#include "opt/adapters/nlopt_solver.h"

namespace halfstep::opt {

const std::vector<NloptMethod>& NloptMethods() {
  // name, algorithm, subsidiary, gradient, inequalities, equalities, finite bounds, least
  // variables, passes
  static const std::vector<NloptMethod> methods = {
      {"nlopt/ccsaq", "LD_CCSAQ", "", true, true, false, false, 1, 200},
      {"nlopt/mma", "LD_MMA", "", true, true, false, false, 1, 2500},
      {"nlopt/slsqp", "LD_SLSQP", "", true, true, true, false, 1, 500},
      {"nlopt/cobyla", "LN_COBYLA", "", false, true, true, false, 1, 0},
      {"nlopt/bobyqa", "LN_BOBYQA", "", false, false, false, false, 2, 0},
      {"nlopt/isres", "GN_ISRES", "", false, true, true, true, 1, 0},
      {"nlopt/auglag_ccsaq", "LD_AUGLAG", "LD_CCSAQ", true, true, true, false, 1, 200},
      {"nlopt/auglag_mma", "LD_AUGLAG", "LD_MMA", true, true, true, false, 1, 2500},
      {"nlopt/auglag_lbfgs", "LD_AUGLAG", "LD_LBFGS", true, true, true, false, 1, 100},
      {"nlopt/auglag_slsqp", "LD_AUGLAG", "LD_SLSQP", true, true, true, false, 1, 500},
      {"nlopt/auglag_bobyqa", "LN_AUGLAG", "LN_BOBYQA", false, true, true, false, 2, 0},
      {"nlopt/auglag_eq_ccsaq", "LD_AUGLAG_EQ", "LD_CCSAQ", true, true, true, false, 1, 200},
  };
  return methods;
}

}  // namespace halfstep::opt
