#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "planner/search/half_step_times.h"
#include "planner/search/step_graph.h"

namespace halfstep {

/// A state that is reached at a time of the walk, and may be kept for some time.
struct TimedState {
  StepState state;     ///< on one foot
  double since = 0.0;  ///< when it is reached [s]
  TimeInterval rest;   ///< the safe interval of resting there that contains `since`
};

/// An element that is taken from a timed state, with the rests before its half-steps.
struct TimedEdge {
  TimedState to;                   ///< where it leads; at the goal only `state` and `since` are set
  double rest_on_one_foot = 0.0;   ///< before its down half-step [s]
  double rest_on_both_feet = 0.0;  ///< before its up half-step [s]
  double latest_up = 0.0;          ///< no earlier than its up half-step begins; it may begin at
                                   ///< any time up to then [s]
};

/// The edges of a StepGraph in time: raw half-steps of equal duration T, and rests between them,
/// each within what HalfStepTimes proves. The walk begins at t = 0 with its first half-step.
class TimedEdges {
 public:
  /// Both are borrowed. T [s] is that of the set's half-steps. The walk rests on one foot until
  /// `begin` [s] after its first half-step, where that is later than T.
  TimedEdges(const HalfStepTimes& times, double T, StepGraph* graph, double begin = 0.0)
      : times_(times), T_(T), graph_(*graph), begin_(begin > T ? begin : T) {}

  /// The state at T, or `begin`, after the first up half-step; none where it must not rest there
  /// until then.
  std::optional<TimedState> Start(const StepState& state) const;
  /// Element k from a state: for each safe interval of resting that it leads to, the earliest
  /// arrival there, if that is not after `latest` [s]. Empty: it is not free, at any time that
  /// would help.
  std::vector<TimedEdge> Take(const TimedState& from, int k,
                              double latest = std::numeric_limits<double>::infinity());
  /// The earliest landing of element k, after which the robot rests on both feet for good.
  std::optional<TimedEdge> Land(const TimedState& from, int k);

  /// What is added to the cost of a plan by each second [1/s], since all elements cost the same.
  double cost_rate() const { return graph_.reach().least_cost() / (2.0 * T_); }
  /// Of getting to a state [of PlanRequest::cost].
  double CostOf(const TimedState& state) const { return (state.since - T_) * cost_rate(); }
  /// When a state of such a cost is reached [s].
  double TimeOf(double cost) const { return cost / cost_rate() + T_; }
  /// Of a walk that ends with this landing.
  double CostOfLanding(const TimedEdge& edge) const { return edge.to.since * cost_rate(); }

 private:
  // When an element's foot lands, and the other one lifts [s].
  struct Taken {
    double lands, lifts;
  };
  // The earliest of `lifts`.
  std::optional<Taken> FirstLift(const TimedState& from, int k, const TimeInterval& lifts);
  // How long it rests on one foot when its down half-step begins at t [s].
  double RestOnOneFoot(const TimedState& from, double t) const {
    return t - (from.since == begin_ ? T_ : from.since);  // the start alone is as early
  }

  const HalfStepTimes& times_;
  double T_;
  StepGraph& graph_;
  double begin_;
};

/// The edges of a chain that begins at `at`: edge j takes element ks[j]. Where the edge after it
/// begins with a rest on one foot, `latest_up` becomes as late as `times` proves, by no more than
/// that rest. `T` as in TimedEdges.
std::vector<TimedEdge> WithLatestUps(const HalfStepTimes& times, const StepGraph& graph,
                                     StepState at, const std::vector<int>& ks,
                                     std::vector<TimedEdge> edges, double T);

/// The rests before the half-steps of a chain of edges, from a start on: of each footstep those on
/// both feet and on one foot [s], as Footstep has them. A rest on one foot becomes one on both feet
/// before it, as far as that is proved as well; arrivals stay. `T` as in TimedEdges.
std::vector<std::array<double, 2>> RestsOf(const std::vector<TimedEdge>& edges, double T);

}  // namespace halfstep
