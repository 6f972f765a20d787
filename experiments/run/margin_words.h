#pragma once

#include <string>
#include <string_view>

#include "smoothing/margins/margin_evaluator.h"

namespace halfstep {

/// A quantity with three digits and its unit, for a screen: "2.2 mm", "0.31 m", "0.31 rad/s".
/// Lengths below 0.1 m are in mm, to 0.1 mm, and to 1 µm below that. A pure number (unit "1") has
/// no unit.
std::string Amount(double value, std::string_view unit);

/// A margin that a motion misses, as a sentence without its end:
/// "RLEG_LINK5 is 2.2 mm inside bar; 5 mm are demanded", "joint_speed of LLEG_JOINT3: 0.31 rad/s
/// beyond its limit".
std::string MissedWords(const MarginEvaluator& evaluator, const Margin& margin);

}  // namespace halfstep
