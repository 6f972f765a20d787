#pragma once

namespace halfstep {

/// The double whose shortest decimal form has at most `digits` significant digits.
double Shortened(double value, int digits = 5);

}  // namespace halfstep
