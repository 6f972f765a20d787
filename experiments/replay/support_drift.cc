#include "experiments/replay/support_drift.h"

#include <algorithm>

namespace halfstep::replay {

SupportDrift DriftOf(const std::vector<DriftSample>& samples, double window) {
  SupportDrift all;
  size_t first = 0;
  for (size_t i = 0; i < samples.size(); ++i) {
    const DriftSample& now = samples[i];
    all.at_end = now.drift;
    all.largest = all.largest.cwiseMax(now.drift.cwiseAbs());
    all.largest_shift = std::max(all.largest_shift, now.drift.head<2>().norm());
    while (now.t - samples[first].t > window) ++first;
    for (size_t k = first; k < i; ++k) {
      const double change = (now.drift - samples[k].drift).head<2>().norm();
      all.within_window = std::max(all.within_window, change);
    }
  }
  return all;
}

}  // namespace halfstep::replay
