#pragma once

#include <algorithm>

namespace halfstep {

/// Under AddressSanitizer, where tests do less.
#ifdef __SANITIZE_ADDRESS__
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

/// `count`, or a tenth of it (at least 1) when sanitized.
constexpr int Draws(int count) { return kSanitized ? std::max(1, count / 10) : count; }

}  // namespace halfstep
