#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/config/experiment_config.h"
#include "experiments/verify/findings.h"
#include "experiments/verify/walk_text.h"
#include "smoothing/methods/dichotomy.h"

namespace halfstep::verify {

/// What is wrong with a row of half_steps.csv by itself, for a half-step that is `planned`: kind,
/// support, numbers that are not finite, a duration that is not positive, a height scale below 0.
/// "": nothing.
std::string FaultOfHalfStep(const HalfStepRow& row, const HalfStep& planned);

/// What is wrong with the two half-steps of a step beside each other: they have one height scale
/// and one support point. "": nothing.
std::string FaultOfStep(const HalfStepRow& up, const HalfStepRow& down);

/// What is wrong with the overlap of two neighbours by what the homotopy allows [s]; "": nothing.
/// Source: smoothing/README.md, "Natural bounds".
std::string FaultOfOverlap(double overlap, const HalfStepRow& before, const HalfStepRow& after,
                           const HalfStep& planned);

/// Whether half_steps.csv and overlaps.csv describe one walk of the footsteps that `planned` was
/// made of: kinds and supports as planned, starts that follow from durations and overlaps,
/// t_{i+1} = t_i + T_i − Δ_i, overlaps within their natural bounds, one height scale and one
/// support point a step, and the same durations and heights in both files. Without `overlaps` the
/// walk is the planned motion: no overlap, the planned rests, durations and support points as
/// planned, scale 1. Returns false when they describe none; then no DescribedWalk may be made of
/// them.
bool CheckOverlaps(const std::vector<HalfStepRow>& half_steps,
                   const std::optional<std::vector<OverlapRow>>& overlaps, const WalkPlan& planned,
                   Findings* findings);

/// Whether `upper_bound_s` of overlaps.csv is the largest overlap that was allowed: the natural
/// bound, times the caps of the dichotomy that `method` is, if it is one. Precondition:
/// CheckOverlaps() returned true.
void CheckUpperBounds(const std::string& method, const std::vector<HalfStepRow>& half_steps,
                      const std::vector<OverlapRow>& overlaps, const WalkPlan& planned,
                      const DichotomyOptions& config, Findings* findings);

/// Whether each parameter in smoothing.fixed has the value that is given there, or else the planned
/// one. A family that is not known here is a disagreement. Precondition: CheckOverlaps() returned
/// true.
void CheckFixed(const std::vector<HalfStepRow>& half_steps, const std::vector<OverlapRow>& overlaps,
                const WalkPlan& planned, const std::vector<FixedConfig>& fixed, Findings* findings);

/// Whether footsteps.csv has the config's footsteps, which `planned` was made of.
void CheckFootsteps(const std::vector<FootstepRow>& rows, const WalkPlan& planned,
                    Findings* findings);

}  // namespace halfstep::verify
