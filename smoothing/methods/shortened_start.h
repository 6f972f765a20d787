#pragma once

#include "smoothing/program/overlap_program.h"

namespace halfstep {

/// A point near which a search for short walks may begin, from a walk that is known: durations are
/// shortened step by step as far as the program's rows, at the instants that it watches, allow when
/// all half-steps are shortened alike; overlaps keep their shares of the natural bounds. What is
/// fixed stays. Nothing is proved of the point.
HomotopyParameters ShortenedStart(const OverlapProgram& program, const HomotopyParameters& from);

}  // namespace halfstep
