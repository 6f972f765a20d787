#include "smoothing/methods/search_ending.h"

#include "smoothing/methods/smoothing_monitor.h"
#include "wpg/files/plain_locale.h"

namespace halfstep {
namespace {

constexpr double kViolated = 0.02;  // of a slack's scale: less may still be proved

}  // namespace

void SearchEnding::Note(const opt::Solution& solution) {
  called = true;
  all_failed = all_failed && solution.ending == opt::Ending::kFailed;
  last_ending = solution.ending;
  last_message = solution.message;
  const bool violated =
      !solution.feasible && !solution.worst_row.empty() && solution.max_violation > kViolated;
  last_violation = violated ? solution.max_violation : 0.0;
  last_violated = violated ? solution.worst_row : "";
}

void SearchEnding::NoteCut(const SmoothingMonitor& monitor) {
  cut = monitor.StopEnding();
  why_cut = monitor.StopReason();
}

opt::Ending SearchEnding::Ending() const {
  using opt::Ending;
  if (!called) return Ending::kNotRun;
  if (!own) {
    if (last_ending == Ending::kInvalidInput) return Ending::kInvalidInput;
    return all_failed ? Ending::kFailed : Ending::kNoImprovement;
  }
  if (cut != Ending::kNotRun) return cut;
  const bool unfinished = exhausted || last_violation > 0.0 || opt::DidNotWork(last_ending);
  return unfinished ? Ending::kLimit : Ending::kConverged;
}

std::string SearchEnding::Sentence() const {
  PlainStream why;
  if (cut != opt::Ending::kNotRun) {
    why << why_cut;
  } else if (last_ending == opt::Ending::kInvalidInput) {
    why << solver << " refused the program";
  } else {
    why << (exhausted ? "all rounds from a start were used"
                      : "the last rounds gained next to nothing");
  }
  if (!called) {
    why << " before " << solver << " was called; " << kept;
    return why.str();
  }
  if (!own) why << "; nothing of its own was better and proved, " << kept;
  if (last_violation > 0.0) {
    why << "; points of the last round stayed violated, " << last_violated << " by at least "
        << last_violation;
  }
  why << "; the last solve of " << solver << " ended with " << opt::Name(last_ending);
  // What was left of the effort for the last round is nobody's concern.
  if (cut == opt::Ending::kNotRun) why << ": " << last_message;
  return why.str();
}

}  // namespace halfstep
