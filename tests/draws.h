#pragma once

#include <algorithm>
#include <random>

namespace halfstep {

/// Under AddressSanitizer, where tests do less.
#ifdef __SANITIZE_ADDRESS__
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

/// `count`, or a tenth of it (at least 1) when sanitized.
constexpr int Draws(int count) { return kSanitized ? std::max(1, count / 10) : count; }

/// A number in [lower, upper), all alike.
inline double Uniform(std::mt19937* random, double lower, double upper) {
  return std::uniform_real_distribution<double>(lower, upper)(*random);
}

}  // namespace halfstep
