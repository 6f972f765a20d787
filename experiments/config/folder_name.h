#pragma once

#include <string>

#include "wpg/files/fields.h"

namespace halfstep {

/// Complains about a `name` that cannot name a folder, or that a shell or a spreadsheet would take
/// for something else.
void CheckName(Fields& fields, const std::string& name);

/// dichotomy/published is a method's name; its folder in a run is dichotomy_published.
std::string MethodFolder(std::string method);

}  // namespace halfstep
