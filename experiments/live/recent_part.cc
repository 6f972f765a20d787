#include "experiments/live/recent_part.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/live/walk_tail.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr int kKept = 12;      // half-steps before the latest that has begun, at least
constexpr int kMostPast = 40;  // fewer are not worth cutting

// How many rests of kLongestRest and less lead to a time [s].
int RestsUntil(double begin) { return 1 + static_cast<int>(begin / (0.9 * kLongestRest)); }

// Rests after each of the first steps, so that the half-step after them begins at `begin` [s], to
// the bit. False where rounding does not allow that.
bool RestUntil(double begin, int steps, WalkPlan* plan) {
  for (int step = 0; step < steps; ++step) {
    const int junction = 2 * step + 1;
    const SuperposedWalk walk = plan->Walk();
    const double duration = walk.tracks(junction).duration(), from = walk.start_of(junction);
    const int left = steps - step - 1;
    const double until = left == 0 ? begin : from + (begin - from) / (left + 1.0);
    double rest = duration - (until - from);
    // As SuperposedWalk adds up.
    const auto reached = [&] { return from + (duration - rest); };
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (int i = 0; left == 0 && i < 16 && reached() != begin; ++i) {
      rest = std::nextafter(rest, reached() < begin ? -kInfinity : kInfinity);
    }
    if (rest > 0.0 || rest <= -kLongestRest || (left == 0 && reached() != begin)) return false;
    Nth(plan->parameters.overlaps, junction) = rest;
  }
  return true;
}

}  // namespace

std::optional<RecentPart> RecentPart::Of(const WalkPlan& plan, const SuperposedWalk& walk,
                                         int begun) {
  if (begun < kMostPast) return std::nullopt;
  const int kept = (begun - kKept) / 2 * 2, rests = RestsUntil(walk.start_of(kept));
  const int first = kept - 2 * rests;
  if (first <= 0) return std::nullopt;
  // What is cut is over when the next half-steps begin that count.
  for (int i = 0; i < kept; ++i) {
    if (walk.end_of(i) > walk.start_of(begun - 2)) return std::nullopt;
  }
  RecentPart part{.plan = TailOf(plan, walk, first).plan, .first = first};
  if (!RestUntil(walk.start_of(kept), rests, &part.plan)) return std::nullopt;
  return part;
}

}  // namespace halfstep
