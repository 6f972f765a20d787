#pragma once

#include <memory>

#include "opt/problem/problem.h"

namespace halfstep {

class OverlapProgram;

/// slacks ≥ 0, or for `safest` raised slacks − z ≥ 0 and the others ≥ 0: the rows of the program's
/// WatchedInstants, each over the variables of its band. Borrows the program.
std::unique_ptr<opt::ConstraintBlock> MakeSlackRows(const OverlapProgram& program);

/// `safest`: D ≤ its limit. Borrows the program.
std::unique_ptr<opt::ConstraintBlock> MakeDurationRow(const OverlapProgram& program);

}  // namespace halfstep
