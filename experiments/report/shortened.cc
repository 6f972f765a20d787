#include "experiments/report/shortened.h"

#include <array>
#include <cstdio>
#include <cstdlib>

namespace halfstep {

double Shortened(double value, int digits) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.*g", digits, value);
  return std::strtod(text.data(), nullptr);
}

}  // namespace halfstep
