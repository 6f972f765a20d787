#pragma once

#include <string>

#include "smoothing/proof/certified_feasibility.h"

namespace halfstep {

/// What a certificate says of a walk that it does not prove, as a sentence: the margin that is
/// violated, or the one that could not be decided and the times between which nothing is known of
/// it [s]. Precondition: the answer is of a proof with these options, and not feasible.
std::string AnswerWords(const MarginEvaluator& evaluator, const CertificationOptions& options,
                        const Feasibility& answer);

}  // namespace halfstep
