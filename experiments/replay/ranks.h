#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace halfstep::replay {

/// What 95 % of some values do not exceed, and the largest; 0 of none.
inline std::pair<double, double> MostAndLargest(std::vector<double> values) {
  if (values.empty()) return {0.0, 0.0};
  constexpr double kMost = 0.95;
  std::ranges::sort(values);
  const auto rank = static_cast<size_t>(std::ceil(kMost * static_cast<double>(values.size())));
  return {values[rank - 1], values.back()};
}

}  // namespace halfstep::replay
