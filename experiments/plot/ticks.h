#pragma once

#include <vector>

#include "experiments/plot/figure.h"

namespace halfstep::plot {

/// Ticks of an axis from low to high at multiples of 1, 2 or 5 times a power of ten, or of a
/// logarithmic one at these numbers, no more than `most`, at least two where the axis holds two.
/// Negative numbers have the sign "−". Precondition: low < high, finite; of a logarithmic axis > 0.
std::vector<Tick> ChosenTicks(const Axis& axis, int most);

/// A number with as many digits behind the point as given, "−" before negative ones.
std::string DecimalText(double value, int digits);

}  // namespace halfstep::plot
