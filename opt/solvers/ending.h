#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace halfstep::opt {

/// How a search ended: that of a solver, or a whole method that calls some. Whatever it is, what is
/// returned was evaluated by us; an ending says how far it is worth looking on, not how good the
/// result is. Every ending comes with a sentence.
enum class Ending {
  kConverged,      ///< its own end, and what it claims there was checked by us
  kLimit,          ///< short of that: iterations, evaluations or rounds used up, or no step helps
  kDeadline,       ///< its time was used up
  kInterrupted,    ///< stopped from outside
  kNoImprovement,  ///< it ran, and the result is what it was started from
  kNotRun,         ///< it was never called
  kInvalidInput,   ///< it refused the problem or an option
  kFailed,         ///< exception, breakdown, a value that is not finite, a claim that does not hold
};

constexpr std::array<Ending, 8> kEndings = {
    Ending::kConverged,     Ending::kLimit,  Ending::kDeadline,     Ending::kInterrupted,
    Ending::kNoImprovement, Ending::kNotRun, Ending::kInvalidInput, Ending::kFailed};

/// "converged", "limit", …
std::string_view Name(Ending ending);
/// One sentence.
std::string_view Meaning(Ending ending);
/// None: no ending is called so.
std::optional<Ending> EndingOf(std::string_view name);
/// "converged, limit, …": all of them, for messages.
std::string EndingNames();

/// Whether a method that ended so has a result of its own, better than what it was started from:
/// of the first four, and of those only. No other is called best, nor to have solved anything.
constexpr bool HasOwnResult(Ending ending) { return ending < Ending::kNoImprovement; }
/// Whether it never searched, or broke: a run with such a method exits with status 1.
constexpr bool DidNotWork(Ending ending) { return ending > Ending::kNoImprovement; }

}  // namespace halfstep::opt
