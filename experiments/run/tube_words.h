#pragma once

#include <string>

#include "smoothing/margins/margin_evaluator.h"

namespace halfstep {

/// What a tube allows and what it adds to the demands, two lines for a screen; "" without a tube:
/// "tube: soles 5.0 mm and 0.5 deg, waist …\n  it raises floor by 6.2 mm, …\n".
std::string TubeWords(const MarginEvaluator& evaluator);

}  // namespace halfstep
