#include "smoothing/methods/search_ending.h"

namespace halfstep {

void SearchEnding::Note(const opt::Solution& solution) {
  called = true;
  all_failed = all_failed && solution.ending == opt::Ending::kFailed;
  last_ending = solution.ending;
  last_message = solution.message;
}

opt::Ending SearchEnding::Ending() const {
  using opt::Ending;
  if (!called) return Ending::kNotRun;
  if (!own) {
    if (last_ending == Ending::kInvalidInput) return Ending::kInvalidInput;
    return all_failed ? Ending::kFailed : Ending::kNoImprovement;
  }
  if (stopped) return Ending::kInterrupted;
  if (past_deadline()) return Ending::kDeadline;
  return exhausted || opt::DidNotWork(last_ending) ? Ending::kLimit : Ending::kConverged;
}

std::string SearchEnding::Sentence() const {
  std::string why = stopped                                     ? "stopped from outside"
                    : past_deadline()                           ? "the deadline passed"
                    : last_ending == opt::Ending::kInvalidInput ? solver + " refused the program"
                    : exhausted ? "all rounds from a start were used"
                                : "the last rounds gained next to nothing";
  if (!called) return why + " before " + solver + " was called; " + kept;
  if (!own) why += "; nothing of its own was better and proved, " + kept;
  return why + "; " + solver + " last ended " + std::string(opt::Name(last_ending)) + ": " +
         last_message;
}

}  // namespace halfstep
