#include "experiments/replay/touch_log.h"

#include <algorithm>

namespace halfstep::replay {
namespace {

// Apart for so long, two bodies touch anew [s].
constexpr double kApart = 0.05;

}  // namespace

void TouchLog::Note(double t, const std::vector<Touch>& touches, bool at_rest) {
  for (const Touch& touch : touches) {
    const auto open = std::find_if(records_.rbegin(), records_.rend(), [&](const TouchRecord& r) {
      return r.body == touch.body && r.obstacle == touch.obstacle;
    });
    if (open == records_.rend() || t - open->end > kApart) {
      records_.push_back({.body = touch.body,
                          .obstacle = touch.obstacle,
                          .begin = t,
                          .end = t,
                          .force = touch.force,
                          .at_rest = at_rest});
      continue;
    }
    open->end = t;
    open->force = std::max(open->force, touch.force);
    open->at_rest = open->at_rest && at_rest;
  }
}

}  // namespace halfstep::replay
