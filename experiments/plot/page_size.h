#pragma once

#include <string>

namespace halfstep::plot {

/// Reads a length as "3.5in", "8.9cm" or "89mm" and gives points. Throws InputError, which begins
/// with `option`, for anything else and for what is not from 1 to 20 inches.
double PointsOf(const std::string& option, const std::string& text);

}  // namespace halfstep::plot
