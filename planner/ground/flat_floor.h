#pragma once

#include <string>

#include "wpg/ground/ground.h"

namespace halfstep {

/// Throws InputError, which begins with `who`, for a ground that is not the plane z = 0 alone: for
/// what knows no other.
void RequireFlatFloor(const Ground& ground, const std::string& who);

}  // namespace halfstep
