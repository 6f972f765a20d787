#pragma once

#include "smoothing/methods/feasible_path.h"
#include "smoothing/program/overlap_program.h"
#include "smoothing/proof/stretch_proofs.h"

namespace halfstep {

/// What a FeasiblePath asks of candidates for a program.

/// `fastest` and `smooth`: a walk deserves its cost when it meets what is demanded. Both are
/// borrowed.
FeasiblePath::Rules DemandedRules(const OverlapProgram& program, StretchProofs* proofs);

/// `safest`: a walk that lasts no longer than it may deserves the cost −z, z ≥ 0, when it meets
/// what is demanded plus z times the family's scale, for the families of Raised(). `within_limit`:
/// whether the first incumbent lasts no longer; of the first walk that does z = 0 is asked. Both
/// are borrowed.
FeasiblePath::Rules SafestRules(const OverlapProgram& program, const FeasibilityTest& test,
                                bool within_limit);

}  // namespace halfstep
