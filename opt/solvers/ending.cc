#include "opt/solvers/ending.h"

#include <algorithm>

namespace halfstep::opt {

std::string_view Name(Ending ending) {
  switch (ending) {
    case Ending::kConverged:
      return "converged";
    case Ending::kLimit:
      return "limit";
    case Ending::kDeadline:
      return "deadline";
    case Ending::kInterrupted:
      return "interrupted";
    case Ending::kNoImprovement:
      return "no_improvement";
    case Ending::kNotRun:
      return "not_run";
    case Ending::kInvalidInput:
      return "invalid_input";
    case Ending::kFailed:
      return "failed";
  }
  return "";
}

std::string_view Meaning(Ending ending) {
  switch (ending) {
    case Ending::kConverged:
      return "It came to its own end, and what it claims there was checked.";
    case Ending::kLimit:
      return "Iterations, evaluations or rounds were used up, or no step helped any more.";
    case Ending::kDeadline:
      return "Its time was used up.";
    case Ending::kInterrupted:
      return "It was stopped from outside.";
    case Ending::kNoImprovement:
      return "It ran, and the result is what it was started from.";
    case Ending::kNotRun:
      return "It was never called.";
    case Ending::kInvalidInput:
      return "It refused the problem or an option.";
    case Ending::kFailed:
      return "It broke down, or what it claims does not hold.";
  }
  return "";
}

std::optional<Ending> EndingOf(std::string_view name) {
  const auto* found =
      std::find_if(kEndings.begin(), kEndings.end(), [&](Ending e) { return Name(e) == name; });
  return found == kEndings.end() ? std::nullopt : std::optional(*found);
}

std::string EndingNames() {
  std::string names;
  for (Ending ending : kEndings) names += (names.empty() ? "" : ", ") + std::string(Name(ending));
  return names;
}

}  // namespace halfstep::opt
