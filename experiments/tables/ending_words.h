#pragma once

#include <string>
#include <string_view>

#include "opt/solvers/ending.h"

namespace halfstep {

/// "ended by the clock, not repeatable" or "stopped from outside, not repeatable" of a method that
/// ended at a moment that no work tells, so that its walk is another one the next time; "": it did
/// not. `message` is SmoothingResult::message, which tells the same where the walk is not the
/// method's own and the ending says that.
std::string_view NotRepeatable(opt::Ending ending, std::string_view message);

/// opt::Meaning, and what NotRepeatable says of the ending alone.
std::string FullMeaning(opt::Ending ending);

}  // namespace halfstep
