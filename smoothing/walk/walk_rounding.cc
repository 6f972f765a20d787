#include "smoothing/walk/walk_rounding.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

// The first and the last half-step that may be under way, by rounding.
std::pair<int, int> UnderWay(const SuperposedWalk& walk, const LocalTime& at, double time) {
  const auto local = [&](int i) {
    return at.tau + (walk.start_of(at.half_step) - walk.start_of(i));
  };
  int first = at.half_step, last = at.half_step;
  while (first > 0 && local(first - 1) < walk.tracks(first - 1).duration() + time) --first;
  while (last + 1 < walk.num_half_steps() && local(last + 1) > -time) ++last;
  return {first, last};
}

}  // namespace

WalkJet RoundingAt(const SuperposedWalk& walk, const LocalTime& at) {
  const double time = LocalTimeRounding(walk, at);
  const auto [first, last] = UnderWay(walk, at, time);
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

WalkState SecondRounding(const SuperposedWalk& walk, double begin, double end) {
  const auto under_way = [&](const LocalTime& at) {
    return UnderWay(walk, at, LocalTimeRounding(walk, at));
  };
  const double half = 0.5 * (end - begin);
  const auto [first, last] = under_way(walk.Locate(begin + half));
  WalkState second = WalkState::Zero();
  // Mostly nothing else is near; LocalTimeRounding is at most an eighth of this.
  const double near = 256.0 * kRoundoff * (walk.duration() + 1.0);
  if ((first == 0 || begin > walk.end_of(first - 1) + near) &&
      (last + 1 == walk.num_half_steps() || end < walk.start_of(last + 1) - near)) {
    return second;
  }
  for (const double t : {begin, end}) {
    const LocalTime at = walk.Locate(t);
    const auto there = under_way(at);
    if (there.first >= first && there.second <= last) continue;
    const WalkJet off = RoundingAt(walk, at);
    second += off.second;
    for (const int q : {kZmpX, kZmpY}) {
      if (half > 0.0) second[q] += off.first[q] / half;
    }
  }
  return second;
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
