#include "planner/search/timed_edges.h"

#include <algorithm>

#include "wpg/nth.h"

namespace halfstep {
namespace {

// The times that two intervals have in common; none: begin > end.
TimeInterval Common(const TimeInterval& a, const TimeInterval& b) {
  return {std::max(a.begin, b.begin), std::min(a.end, b.end)};
}
bool IsEmpty(const TimeInterval& interval) { return interval.begin > interval.end; }
TimeInterval Later(const TimeInterval& interval, double by) {
  return {interval.begin + by, interval.end + by};
}

}  // namespace

std::optional<TimedState> TimedEdges::Start(const StepState& state) const {
  const TimeIntervals rests = times_.OnOneFoot(state.support, state.X_WS);
  const TimeInterval* rest = IntervalAt(rests, T_);
  if (rest == nullptr || rest->end < begin_) return std::nullopt;
  return TimedState{.state = state, .since = begin_, .rest = *rest};
}

std::vector<TimedEdge> TimedEdges::Take(const TimedState& from, int k) {
  std::vector<TimedEdge> edges;
  const StepState &at = from.state, to = graph_.After(at, k);
  if (!graph_.DownIsFree(at, k) || !graph_.UpIsFree(at, k)) return edges;
  const int i = Nth(graph_.elements(), k);
  const TimeIntervals rests = times_.OnOneFoot(to.support, to.X_WS);
  if (rests.empty()) return edges;
  const TimeIntervals downs = times_.DownStarts(i, at.support, at.X_WS, to.X_WS);
  const TimeInterval here{from.since, from.rest.end};
  if (std::ranges::none_of(
          downs, [&](const TimeInterval& down) { return !IsEmpty(Common(down, here)); })) {
    return edges;
  }
  const TimeIntervals ups = times_.UpStarts(i, at.support, at.X_WS, to.X_WS);
  if (ups.empty()) return edges;
  const TimeIntervals stands = times_.OnBothFeet(i, at.support, at.X_WS, to.X_WS);
  for (const TimeInterval& rest : rests) {
    std::optional<TimedEdge> best;
    for (const TimeInterval& down : downs) {
      const TimeInterval starts = Common(down, here);
      if (IsEmpty(starts)) continue;
      for (const TimeInterval& stand : stands) {
        const TimeInterval lands = Common(Later(starts, T_), stand);
        if (IsEmpty(lands)) continue;
        for (const TimeInterval& up : ups) {
          TimeInterval lifts = Common(Common(up, {lands.begin, stand.end}), Later(rest, -T_));
          if (IsEmpty(lifts)) continue;
          const double since = lifts.begin + T_;
          if (best && since >= best->to.since) continue;
          // Rounding of t − T + T must not leave the interval.
          best = TimedEdge{.to = {to, std::clamp(since, rest.begin, rest.end), rest},
                           .rest_on_one_foot = RestOnOneFoot(from, lands.begin - T_),
                           .rest_on_both_feet = lifts.begin - lands.begin,
                           .latest_up = lifts.end};
        }
      }
    }
    if (best) edges.push_back(*best);
  }
  return edges;
}

std::optional<TimedEdge> TimedEdges::Land(const TimedState& from, int k) {
  const StepState& at = from.state;
  if (!graph_.DownIsFree(at, k)) return std::nullopt;
  const int i = Nth(graph_.elements(), k);
  const Foothold X_WF = graph_.Landing(at, k);
  const TimeIntervals stands = times_.OnBothFeet(i, at.support, at.X_WS, X_WF);
  if (stands.empty() || stands.back().end < times_.settled()) return std::nullopt;
  for (const TimeInterval& down : times_.DownStarts(i, at.support, at.X_WS, X_WF)) {
    const TimeInterval starts = Common(down, {from.since, from.rest.end});
    const TimeInterval lands = Common(Later(starts, T_), stands.back());
    if (IsEmpty(starts) || IsEmpty(lands)) continue;
    TimedEdge edge;
    edge.to.state = {X_WF, Opposite(at.support)};
    edge.to.since = lands.begin;
    edge.rest_on_one_foot = RestOnOneFoot(from, lands.begin - T_);
    return edge;
  }
  return std::nullopt;
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
