#pragma once

#include <string>

#include "experiments/verify/findings.h"

namespace halfstep::verify {

/// Whether config.yaml demands the stop branches that `acceptance`, of manifest.json, says were
/// demanded.
void CheckDemandOfStopBranches(const std::string& branches, const std::string& acceptance,
                               Findings* findings);

}  // namespace halfstep::verify
