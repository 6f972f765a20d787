#pragma once

#include <functional>
#include <string>

#include "wpg/files/fields.h"

namespace halfstep {

/// Takes a number that was declared: its path from the root ("half_step.duration_s"), where it is
/// kept, and what is said about it.
using NumberVisit =
    std::function<void(const std::string& path, double* value, const NumberSpec& spec)>;

/// Calls `visit` for every Fields::Number, and every OptionalNumber with a value, that `declare`
/// declares, also in groups that may be absent, but not in lists, in the order of the declaration.
/// `visit` may change the value.
void VisitNumbers(const std::function<void(Fields&)>& declare, const NumberVisit& visit);

}  // namespace halfstep
