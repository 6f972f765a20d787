#pragma once

#include <algorithm>
#include <cstdlib>
#include <random>

namespace halfstep {

/// Under AddressSanitizer, where tests do less.
#ifdef __SANITIZE_ADDRESS__
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

/// Whether tests draw a tenth: when sanitized, and for tests/run.sh without --all.
inline const bool kFewDraws = kSanitized || std::getenv("HALFSTEP_FEW_DRAWS") != nullptr;

/// `count`, or a tenth of it (at least 1) with few draws.
inline int Draws(int count) { return kFewDraws ? std::max(1, count / 10) : count; }

/// A number in [lower, upper), all alike.
inline double Uniform(std::mt19937* random, double lower, double upper) {
  return std::uniform_real_distribution<double>(lower, upper)(*random);
}

}  // namespace halfstep
