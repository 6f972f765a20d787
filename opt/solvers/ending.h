#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace halfstep::opt {

/// How a search ended: a single solve, or a whole method that calls solvers. In every case the
/// result was evaluated by us; the ending says whether it is worth searching further, not how good
/// the result is. Every ending comes with a sentence.
enum class Ending {
  kConverged,      ///< by its own criterion, and we checked what it claims
  kLimit,          ///< iterations, evaluations or rounds were used up, or no step helps
  kDeadline,       ///< its time was used up
  kInterrupted,    ///< stopped from outside
  kNoImprovement,  ///< it ran, and the result is what it was started from
  kNotRun,         ///< it was never called
  kInvalidInput,   ///< it refused the problem or an option
  kFailed,         ///< exception, breakdown, a value that is not finite, a claim that does not hold
};

/// All of them.
constexpr std::array<Ending, 8> kEndings = {
    Ending::kConverged,     Ending::kLimit,  Ending::kDeadline,     Ending::kInterrupted,
    Ending::kNoImprovement, Ending::kNotRun, Ending::kInvalidInput, Ending::kFailed};

/// "converged", "limit", …
std::string_view Name(Ending ending);
/// What the ending means, in one sentence.
std::string_view Meaning(Ending ending);
/// The ending of that name; none for an unknown name.
std::optional<Ending> EndingOf(std::string_view name);
/// All names, "converged, limit, …", for messages.
std::string EndingNames();

/// Whether a method that ended so has a result of its own that is better than its start: true of
/// the first four endings only. No other method may be called the best, or said to have solved a
/// problem.
constexpr bool HasOwnResult(Ending ending) { return ending < Ending::kNoImprovement; }
/// Whether a method that ended so never searched, or broke; a run with one exits with status 1.
constexpr bool DidNotWork(Ending ending) { return ending > Ending::kNoImprovement; }

}  // namespace halfstep::opt
