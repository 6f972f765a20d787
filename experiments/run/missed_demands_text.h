#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "smoothing/proof/missed_demands.h"
#include "wpg/motion/half_step_sequence.h"

namespace halfstep {

/// Where in a plan a demand is missed: "footstep 1 (right), half-step up, at 1.48 s"; of a foot
/// that stands in the way, the footstep that put it there, "footstep 5 (right), where it stands,
/// from 18.70 s on"; "at the start".
std::string PlaceInPlan(const HalfStepSequence& sequence, const MissedDemand& demand);

/// What a motion along `sequence` misses and what may help, a line each: ten demands, or the
/// worst of each family where these are more, the worst first ("footstep 1 (right), half-step up,
/// at 1.48 s: RLEG_LINK5 is 2.2 mm inside bar; 5.0 mm demanded (at 2 of 301 instants)"), then how
/// many there are besides, then a remedy for each family that is among them.
std::vector<std::string> MissedDemandsText(const MarginEvaluator& evaluator,
                                           const HalfStepSequence& sequence,
                                           const MissedDemands& missed);

/// The last of these lines alone: what may help with each family that is told.
std::vector<std::string> FamilyRemedies(const MarginEvaluator& evaluator,
                                        const MissedDemands& missed);

/// All missed demands as a list of objects in the same order, each with its sentence, its footstep
/// (from 1; 0: the start), the instant, family, subject, margin (null: it is not finite) and what
/// is demanded.
nlohmann::ordered_json MissedDemandsJson(const MarginEvaluator& evaluator,
                                         const HalfStepSequence& sequence,
                                         const MissedDemands& missed);

}  // namespace halfstep
