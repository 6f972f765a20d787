#include "smoothing/walk/walk_rounding.h"

#include <algorithm>
#include <cmath>

#include "wpg/rounded.h"

namespace halfstep {
namespace {

// How often places of footholds are computed one from another: once, or where footsteps are moved
// as that of the planned one, of the moved one, and of the support sole.
double PlacesOf(const HomotopyParameters& p) {
  const auto zero = [](double move) { return move == 0.0; };
  const bool rest = std::ranges::all_of(p.footstep_xs, zero) &&
                    std::ranges::all_of(p.footstep_ys, zero) &&
                    std::ranges::all_of(p.footstep_yaws, zero);
  return rest ? 1.0 : 3.0;
}

}  // namespace

WalkJet RoundingAt(const SuperposedWalk& walk, const LocalTime& at) {
  const auto local = [&](int i) {
    return at.tau + (walk.start_of(at.half_step) - walk.start_of(i));
  };
  const double time = LocalTimeRounding(walk, at);
  int first = at.half_step, last = at.half_step;
  while (first > 0 && local(first - 1) < walk.tracks(first - 1).duration() + time) --first;
  while (last + 1 < walk.num_half_steps() && local(last + 1) > -time) ++last;
  const double places = PlacesOf(walk.parameters());
  WalkJet error, size;
  error.value = walk.tracks(first).StartRounding(places);
  size.value = walk.tracks(first).start().cwiseAbs();
  for (int i = first; i <= last; ++i) walk.tracks(i).AddRounding(time, places, &error, &size);
  const double sums = (last - first + 1) * kRoundoff;
  error.value += sums * size.value;
  error.first += sums * size.first;
  error.second += sums * size.second;
  return error;
}

// Of the difference of starts at most three half-steps apart, of a knot and of an interval's ends:
// sums of two terms each, no larger than the time at which the half-step ends.
double LocalTimeRounding(const SuperposedWalk& walk, const LocalTime& at) {
  const double longest = walk.tracks(at.half_step).duration() + std::abs(at.tau);
  return 16.0 * kRoundoff * (walk.start_of(at.half_step) + longest);
}

double TimeRounding(const SuperposedWalk& walk, int half_step) {
  return 2.0 * kRoundoff * (half_step + 8.0) * (walk.end_of(half_step) + 1.0);
}

}  // namespace halfstep
