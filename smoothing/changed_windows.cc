#include "smoothing/changed_windows.h"

#include <algorithm>

namespace halfstep {

std::vector<TimeWindow> ChangedWindows(const HomotopyParameters& from, const SuperposedWalk& walk) {
  const HomotopyParameters& to = walk.parameters();
  std::vector<TimeWindow> windows;
  const auto add = [&](double begin, double end) {
    if (!windows.empty() && begin <= windows.back().end) {
      windows.back().end = std::max(windows.back().end, end);
    } else {
      windows.push_back({begin, end});
    }
  };
  // Half-steps start in order, so the windows do.
  for (int i = 0; i < walk.num_half_steps(); ++i) {
    const size_t k = static_cast<size_t>(i);
    if (from.durations[k] != to.durations[k] ||
        from.height_scales[k / 2] != to.height_scales[k / 2]) {
      add(walk.start_of(i), walk.end_of(i));
    }
    if (k < to.overlaps.size() && from.overlaps[k] != to.overlaps[k]) {
      add(walk.start_of(i), walk.end_of(i + 1));
    }
  }
  return windows;
}

}  // namespace halfstep
