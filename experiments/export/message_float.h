#pragma once

#include <string>

namespace halfstep {

/// A float64 of a ROS message in YAML, in the shortest form that reads back to the same double:
/// with a point, so that no reader takes it for an integer or, with an exponent, for a text.
/// Precondition: finite.
std::string MessageFloat(double value);

}  // namespace halfstep
