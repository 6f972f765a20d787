#pragma once

#include <stop_token>

#include "experiments/live/live_config.h"
#include "experiments/live/proposal.h"
#include "experiments/live/safety.h"

namespace halfstep {

/// Finds the overlaps of the next few junctions of a proposal's walk that were not found yet, no
/// more than `ahead` behind half-step `begun`, so that nothing begins before `from` [s]; false when
/// there are none. What is found, the walk and its stop branches, is proved in the world of
/// `safety`. Precondition: so is the proposal's walk. When `stop` is requested, nothing is found.
bool FindOverlaps(const SafetyCheck& safety, const LiveConfig& config, double from, int begun,
                  int ahead, Proposal* proposal, std::stop_token stop = {});

}  // namespace halfstep
