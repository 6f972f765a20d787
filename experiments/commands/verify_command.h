#pragma once

#include <vector>

#include "experiments/run/exit_status.h"
#include "experiments/verify/verify_run.h"

namespace halfstep {

/// The exit status of `halfstep verify` after these results: of several methods the worst counts.
ExitStatus StatusOf(const std::vector<verify::MethodVerification>& results);

}  // namespace halfstep
