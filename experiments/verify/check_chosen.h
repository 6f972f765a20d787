#pragma once

#include <string>
#include <vector>

#include "experiments/config/experiment_config.h"
#include "experiments/verify/findings.h"
#include "experiments/verify/walk_text.h"

namespace halfstep::verify {

/// Whether a method's walk has what config.yaml does not let methods move (`footsteps: false`,
/// `zmp_shifts: false` and the like of smoothing.optimizer) as it is planned, or fixed at another
/// value. The method `given` moves whatever it was given; heights and durations some methods move
/// whatever these keys say, so they are not looked at. Precondition: CheckOverlaps() returned true.
void CheckChosen(const std::string& method, const std::vector<HalfStepRow>& half_steps,
                 const WalkPlan& planned, const SmoothingConfig& config, Findings* findings);

}  // namespace halfstep::verify
