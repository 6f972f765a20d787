#pragma once

#include <nlohmann/json_fwd.hpp>

#include "smoothing/margins/margin_evaluator.h"

namespace halfstep {

/// `tube` of certificate.json: its distances [m, rad, rad/s]; under `raised` what it adds to what
/// is demanded of each family that holds in it, of those that the robot has; under `taken` what it
/// takes at most from the margin of a body and of a pair of bodies [m].
nlohmann::ordered_json TubeJson(const MarginEvaluator& evaluator);

}  // namespace halfstep
