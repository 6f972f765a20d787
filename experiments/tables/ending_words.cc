#include "experiments/tables/ending_words.h"

namespace halfstep {

std::string_view NotRepeatable(opt::Ending ending, std::string_view message) {
  // As SmoothingMonitor::StopReason begins.
  if (ending == opt::Ending::kDeadline || message.starts_with("ended by the clock")) {
    return "ended by the clock, not repeatable";
  }
  if (ending == opt::Ending::kInterrupted || message.starts_with("stopped from outside")) {
    return "stopped from outside, not repeatable";
  }
  return "";
}

std::string FullMeaning(opt::Ending ending) {
  const std::string meaning(Meaning(ending)), words(NotRepeatable(ending, ""));
  return words.empty() ? meaning : meaning + " (" + words + ")";
}

}  // namespace halfstep
