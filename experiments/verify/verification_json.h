#pragma once

#include <string>
#include <vector>

#include "experiments/verify/verify_run.h"

namespace halfstep::verify {

/// What `halfstep verify --json` prints: `methods`, each with `method`, `verified`, `readable`,
/// `checks`, `too_coarse`, `reasons`, `disagreements`, `complaints`, `statement` and `not_covered`
/// as MethodVerification has them; and `not_examined`, the list of NotExamined that is theirs.
std::string VerificationJson(const std::vector<MethodVerification>& results);

}  // namespace halfstep::verify
