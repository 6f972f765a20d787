#include "planner/search/timed_edges.h"

#include <algorithm>
#include <cmath>

#include "wpg/nth.h"

namespace halfstep {
namespace {

bool IsEmpty(const TimeInterval& interval) { return interval.begin > interval.end; }
TimeInterval Later(const TimeInterval& interval, double by) {
  return {interval.begin + by, interval.end + by};
}

// What is asked about at once [s]: answers cost work, and the first one mostly ends the search.
constexpr double kAtOnce = 1.0;

// The end of what is asked about from `begin` on.
double UntilFrom(double begin, double end, double settled) {
  return begin >= settled || begin + kAtOnce >= end ? end : begin + kAtOnce;
}

// The earliest of the times within `within` that `ask` tells.
template <class Ask>
std::optional<double> First(const Ask& ask, const TimeInterval& within) {
  if (IsEmpty(within)) return std::nullopt;
  for (const TimeInterval& found : ask(within)) {
    const TimeInterval common = Common(found, within);
    if (!IsEmpty(common)) return common.begin;
  }
  return std::nullopt;
}

}  // namespace

std::optional<TimedState> TimedEdges::Start(const StepState& state) const {
  const TimeIntervals rests = times_.OnOneFoot(state.support, state.X_WS, {.begin = T_});
  const TimeInterval* rest = IntervalAt(rests, T_);
  if (rest == nullptr || rest->end < begin_) return std::nullopt;
  return TimedState{.state = state, .since = begin_, .rest = *rest};
}

std::vector<TimedEdge> TimedEdges::Take(const TimedState& from, int k, double latest) {
  std::vector<TimedEdge> edges;
  const StepState &at = from.state, to = graph_.After(at, k);
  if (!graph_.DownIsFree(at, k) || !graph_.UpIsFree(at, k)) return edges;
  for (const TimeInterval& rest :
       times_.OnOneFoot(to.support, to.X_WS, {.begin = from.since + 2.0 * T_})) {
    const TimeInterval lifts = Later(Common(rest, {.begin = 0.0, .end = latest}), -T_);
    const auto taken = FirstLift(from, k, lifts);
    if (!taken) continue;
    // Rounding of t − T + T must not leave the interval.
    edges.push_back({.to = {to, std::clamp(taken->lifts + T_, rest.begin, rest.end), rest},
                     .rest_on_one_foot = RestOnOneFoot(from, taken->lands - T_),
                     .rest_on_both_feet = taken->lifts - taken->lands,
                     .latest_up = taken->lifts});
  }
  return edges;
}

std::optional<TimedEdges::Taken> TimedEdges::FirstLift(const TimedState& from, int k,
                                                       const TimeInterval& lifts) {
  const StepState& at = from.state;
  const int i = Nth(graph_.elements(), k);
  const Foothold X_WF = graph_.Landing(at, k);
  const auto stands_within = [&](const TimeInterval& within) {
    return times_.OnBothFeet(i, at.support, at.X_WS, X_WF, within);
  };
  const auto downs = [&](const TimeInterval& within) {
    return times_.DownStarts(i, at.support, at.X_WS, X_WF, within);
  };
  const auto ups = [&](const TimeInterval& within) {
    return times_.UpStarts(i, at.support, at.X_WS, X_WF, within);
  };
  const TimeInterval lands = Common({from.since + T_, from.rest.end + T_}, {0.0, lifts.end});
  for (double begin = lands.begin; begin <= lands.end;) {
    const TimeInterval now{begin, UntilFrom(begin, lands.end, times_.settled())};
    std::optional<double> landed;
    for (const TimeInterval& stand : stands_within(now)) {
      const TimeInterval within = Common(stand, now);
      if (IsEmpty(within)) continue;
      const auto down = First(downs, Later(within, -T_));
      if (down) landed = std::clamp(*down + T_, within.begin, within.end);
      if (down) break;
    }
    if (!landed && now.end == lands.end) break;
    begin = now.end;
    if (!landed) continue;
    // For as long as it may stand there: to land later in that time does not lift it earlier.
    double stood = *landed;
    for (bool stands_on = true; stands_on;) {
      const double until = UntilFrom(stood, lifts.end, times_.settled());
      const TimeIntervals stands = stands_within({stood, until});
      const TimeInterval* stand = IntervalAt(stands, stood);
      const double end = stand == nullptr ? stood : std::min(stand->end, until);
      if (const auto lift = First(ups, Common({stood, end}, lifts))) return Taken{*landed, *lift};
      if (end == lifts.end) return std::nullopt;
      stands_on = end == until;
      stood = end;
    }
    begin = std::nextafter(stood, lifts.end);
  }
  return std::nullopt;
}

std::optional<TimedEdge> TimedEdges::Land(const TimedState& from, int k) {
  const StepState& at = from.state;
  if (!graph_.DownIsFree(at, k)) return std::nullopt;
  const int i = Nth(graph_.elements(), k);
  const Foothold X_WF = graph_.Landing(at, k);
  const double settled = times_.settled();
  const TimeInterval lands{from.since + T_, from.rest.end + T_};
  const TimeIntervals stands =
      times_.OnBothFeet(i, at.support, at.X_WS, X_WF, {.begin = lands.begin});
  if (stands.empty() || stands.back().end < settled) return std::nullopt;
  const auto downs = [&](const TimeInterval& within) {
    return times_.DownStarts(i, at.support, at.X_WS, X_WF, within);
  };
  const TimeInterval within = Later(Common(stands.back(), lands), -T_);
  std::optional<double> down;
  for (double begin = within.begin; !down && begin <= within.end;) {
    const double until = UntilFrom(begin, within.end, settled);
    down = First(downs, {begin, until});
    if (until == within.end) break;
    begin = until;
  }
  if (!down) return std::nullopt;
  TimedEdge edge;
  edge.to.state = {X_WF, Opposite(at.support)};
  edge.to.since = *down + T_;
  edge.rest_on_one_foot = RestOnOneFoot(from, *down);
  return edge;
}

std::vector<TimedEdge> WithLatestUps(const HalfStepTimes& times, const StepGraph& graph,
                                     StepState at, const std::vector<int>& ks,
                                     std::vector<TimedEdge> edges, double T) {
  for (size_t j = 0; j + 1 < edges.size(); ++j) {
    const int k = ks[j], i = Nth(graph.elements(), k);
    const StepState to = graph.After(at, k);
    TimedEdge& edge = edges[j];
    const TimeInterval wanted{
        edge.latest_up,
        std::min(edge.latest_up + edges[j + 1].rest_on_one_foot, edge.to.rest.end - T)};
    if (wanted.begin < wanted.end) {
      const TimeIntervals ups = times.UpStarts(i, at.support, at.X_WS, to.X_WS, wanted);
      const TimeIntervals stands = times.OnBothFeet(i, at.support, at.X_WS, to.X_WS, wanted);
      const TimeInterval* up = IntervalAt(ups, wanted.begin);
      const TimeInterval* stand = IntervalAt(stands, wanted.begin);
      if (up != nullptr && stand != nullptr) {
        edge.latest_up = std::min({wanted.end, up->end, stand->end});
      }
    }
    at = to;
  }
  return edges;
}

std::vector<std::array<double, 2>> RestsOf(const std::vector<TimedEdge>& edges, double T) {
  // Half-steps that follow each other at once do so but for rounding.
  constexpr double kRounding = 1e-9;
  std::vector<std::array<double, 2>> rests(edges.size(), {0.0, 0.0});
  double moved = 0.0;  // by which the up half-step behind an edge begins later
  for (size_t j = edges.size(); j-- > 0;) {
    const TimedEdge& edge = edges[j];
    if (j + 1 < edges.size()) {
      const double both = edge.rest_on_both_feet + moved;
      rests[j + 1][0] = both > kRounding ? both : 0.0;
    }
    moved = 0.0;
    double on_one = edge.rest_on_one_foot;
    if (j > 0) {
      const TimedEdge& before = edges[j - 1];
      moved = std::clamp(before.latest_up + T - before.to.since, 0.0, on_one);
      on_one -= moved;
    }
    rests[j][1] = on_one > kRounding ? on_one : 0.0;
  }
  return rests;
}

}  // namespace halfstep
