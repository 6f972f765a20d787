#pragma once

#include <cstdint>
#include <random>

namespace halfstep::replay {

/// Numbers drawn by a seed, the same on every machine.
class SeedDraws {
 public:
  /// Those of a seed ≥ 1.
  explicit SeedDraws(int seed) : random_(static_cast<std::uint64_t>(seed)) {}

  /// Evenly between both.
  double Between(double least, double most) {
    const double part = static_cast<double>(random_() >> 11) * 0x1p-53;
    return least + part * (most - least);
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace halfstep::replay
