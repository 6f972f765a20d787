#include "experiments/tables/answer_words.h"

#include <algorithm>

#include "wpg/files/text.h"

namespace halfstep {

std::string AnswerWords(const MarginEvaluator& evaluator, const CertificationOptions& options,
                        const Feasibility& answer) {
  if (answer.stopped) return "interrupted before all of it was proved";
  const Margin& witness = answer.witness;
  std::string words = evaluator.Describe(witness);
  if (answer.verdict != Verdict::kUndecided) return words;
  // Intervals are halved until they are shorter than the resolution; the witness is in the middle.
  const double half = 0.5 * options.resolution;
  return words + Formatted("; nothing is proved of it between %.6g s and %.6g s",
                           std::max(0.0, witness.t - half), witness.t + half);
}

}  // namespace halfstep
