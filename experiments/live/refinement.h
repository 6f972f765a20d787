#pragma once

#include "experiments/live/live_config.h"
#include "experiments/live/proposal.h"
#include "experiments/live/safety.h"

namespace halfstep {

/// Shortens the next half-steps of a proposal's walk that can still be changed when a successor is
/// taken `live.budget.refine_s` after `from` [s], half-step `begun` having begun: their overlaps,
/// and the heights, durations and support points that smoothing.optimizer lets methods move. What
/// is found, the walk and its stop branches, is proved in the world of `safety`. By the wall clock
/// the search ends after that budget. Precondition: the proposal's walk is proved in that world, to
/// its end. Source: smoothing/README.md, "Windows".
void Refine(const SafetyCheck& safety, const LiveConfig& config, double from, int begun,
            Proposal* proposal);

}  // namespace halfstep
