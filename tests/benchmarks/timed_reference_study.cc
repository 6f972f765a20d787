// A brute search in time, as a reference for planning in time (planner/README.md):
//   timed_reference_study CONFIG [SPARE [SPACING [YAW]]]
// Breadth first over each 0.1 s of a walk: raw half-steps of the set follow one another, and the
// robot may rest for any number of tenths. Of the set those elements count that lie on a lattice
// along x (SPACING [m], default 0.1) and turn by no more than YAW ([rad], default 0), so that
// states meet exactly. What rests is asked of swept volumes; what moves is looked at each 0.1 s,
// each body of the robot SPARE [m] (default 0) farther off than demanded. The walk that arrives
// first is then certified at its times; only so is it found.
// Prints when it arrives [s] or "none", how many footsteps it has, what was looked at, the
// footsteps.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <unordered_map>
#include <vector>

#include "experiments/config/experiment.h"
#include "experiments/run/certified_half_steps.h"
#include "experiments/run/plan_by_volumes.h"
#include "experiments/run/planning.h"
#include "planner/scene/scene_parts.h"
#include "planner/search/pose_cells.h"
#include "planner/search/step_graph.h"
#include "planner/swept/swept_volume_query.h"
#include "tests/benchmarks/sampled_times.h"
#include "wpg/nth.h"

namespace {

using namespace halfstep;

using Ticks = SampledTimes::Ticks;
constexpr double kTick = SampledTimes::kTick;
constexpr int kTicks = SampledTimes::kTicks;

bool Bit(const Ticks& ticks, int k) { return ticks[static_cast<size_t>(k)]; }

class Brute {
 public:
  Brute(const PlanRequest& request, const std::vector<int>& elements, SampledTimes* times)
      : request_(request),
        T_(static_cast<int>(std::lround(request.set.prototype.duration / kTick))),
        graph_(request, elements),
        times_(*times),
        waiting_(kTicks + 1) {}

  size_t states() const { return known_.size(); }

  // The walk that arrives first.
  std::optional<std::vector<Footstep>> Run() {
    for (const StepState& start : graph_.FreeStarts()) Arrive({StateAt(start), T_, -1, 0, 0, 0, 0});
    for (int tick = 0; tick + 2 * T_ < kTicks; ++tick) {
      for (const int arrival : Nth(waiting_, tick)) {
        const int at = Nth(arrivals_, arrival).state;
        for (int k = 0; k < graph_.size(); ++k) {
          if (auto walk = Take(at, arrival, tick, k)) return walk;
        }
        WaitAt(at, arrival, tick + 1);
      }
    }
    return std::nullopt;
  }

 private:
  // When an element may be taken from a state, and where it leads: −1 nowhere.
  struct Edge {
    Ticks downs = {}, stands = {}, ups = {}, seen = {};
    int to = -1;
    bool lands = false;
  };
  struct Known {
    StepState state;
    Ticks rests, seen = {};
    std::vector<std::optional<Edge>> edges;  // by k
  };
  // At a state at a tick, by element k from another, whose half-steps begin at `down` and `up`.
  struct Arrival {
    int state, tick, before, k, down, land, up;
  };

  int StateAt(const StepState& state) {
    const int next = static_cast<int>(known_.size());
    const auto [at, is_new] = index_.try_emplace(PoseCells{}.KeyOf(state), next);
    if (is_new) {
      known_.push_back(
          {.state = state,
           .rests = times_.Starts(SampledTimes::kOneFoot, 0, state.support, state.X_WS),
           .edges = std::vector<std::optional<Edge>>(request_.set.placements.size())});
    }
    // Who is at another place of the cell would have to jump.
    const Foothold& is = Nth(known_, at->second).state.X_WS;
    const bool same = std::hypot(is.x - state.X_WS.x, is.y - state.X_WS.y) < 1e-9 &&
                      std::fabs(is.yaw - state.X_WS.yaw) < 1e-9;
    return same ? at->second : -1;
  }

  void WaitAt(int state, int arrival, int tick) {
    Known& known = Nth(known_, state);
    const auto bit = static_cast<size_t>(tick);
    if (!known.rests[bit] || known.seen[bit]) return;
    known.seen.set(bit);
    Nth(waiting_, tick).push_back(arrival);
  }
  void Arrive(const Arrival& arrival) {
    if (arrival.state < 0) return;
    arrivals_.push_back(arrival);
    WaitAt(arrival.state, static_cast<int>(arrivals_.size()) - 1, arrival.tick);
  }

  Edge EdgeOf(const StepState& from, int k) {
    Edge edge;
    const StepState after = graph_.After(from, k);
    edge.lands = graph_.IsGoal(from, after.X_WS);
    const bool inside = graph_.workspace().contains(after.X_WS.Planar().position());
    if (!graph_.DownIsFree(from, k)) return edge;
    if (!edge.lands && (!inside || !graph_.UpIsFree(from, k))) return edge;
    const int i = Nth(graph_.elements(), k);
    edge.downs = times_.Starts(SampledTimes::kDown, i, from.support, from.X_WS);
    edge.stands = times_.Starts(SampledTimes::kBothFeet, i, from.support, from.X_WS);
    edge.ups =
        edge.lands ? edge.stands : times_.Starts(SampledTimes::kUp, i, after.support, after.X_WS);
    if (edge.downs.any() && edge.ups.any()) edge.to = edge.lands ? 0 : StateAt(after);
    return edge;
  }

  // Begins element k at a tick; the walk, where that ends it.
  std::optional<std::vector<Footstep>> Take(int at, int arrival, int tick, int k) {
    if (!Nth(Nth(known_, at).edges, k)) {
      const StepState from = Nth(known_, at).state;
      const Edge made = EdgeOf(from, k);  // which may move states in memory
      Nth(Nth(known_, at).edges, k) = made;
    }
    Edge& edge = *Nth(Nth(known_, at).edges, k);
    if (edge.to < 0 || !Bit(edge.downs, tick)) return std::nullopt;
    const int land = tick + T_;
    if (edge.lands) {
      const bool for_good = (~edge.stands >> static_cast<size_t>(land)).none();
      if (!for_good) return std::nullopt;
      return WalkTo({-1, land, arrival, k, tick, land, land});
    }
    const int to = edge.to;
    for (int u = land; u + T_ < kTicks && Bit(edge.stands, u); ++u) {
      if (Bit(edge.seen, u)) break;
      edge.seen.set(static_cast<size_t>(u));
      if (Bit(edge.ups, u)) Arrive({to, u + T_, arrival, k, tick, land, u});
    }
    return std::nullopt;
  }

  std::vector<Footstep> WalkTo(Arrival last) const {
    std::vector<Footstep> steps;
    while (last.before >= 0) {
      if (!steps.empty()) steps.back().rest = kTick * (last.up - last.land);
      const Arrival& before = Nth(arrivals_, last.before);
      const StepState& from = Nth(known_, before.state).state;
      steps.push_back({.side = Opposite(from.support),
                       .X_WF = graph_.Landing(from, last.k),
                       .via_height = request_.set.prototype.via_height,
                       .duration = request_.set.prototype.duration,
                       .rest_on_one_foot = kTick * (last.down - before.tick)});
      last = before;
    }
    std::ranges::reverse(steps);
    return steps;
  }

  const PlanRequest& request_;
  int T_;  // of a half-step, in ticks
  StepGraph graph_;
  SampledTimes& times_;
  std::vector<Known> known_;
  std::unordered_map<std::uint64_t, int> index_;
  std::vector<Arrival> arrivals_;
  std::vector<std::vector<int>> waiting_;  // by tick: arrivals at states that are held then
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 1;
  const auto number = [&](int k, double otherwise) {
    return argc > k ? std::atof(argv[k]) : otherwise;
  };
  const double spare = number(2, 0.0), spacing = number(3, 0.1), yaw = number(4, 0.0);
  const ExperimentConfig config = LoadConfig(argv[1], {});
  const Place place = LoadPlace(config);
  const BakedHalfSteps baked = BakeHalfSteps(place.robot, config, *place.scene.ground, {});
  const StepSet& set = baked.cached.volumes->set;
  std::vector<int> elements;
  for (int i = 0; i < set.size(); ++i) {
    const Foothold& X_SF = Nth(set.placements, i);
    const bool on_lattice = std::fabs(std::remainder(X_SF.x, spacing)) < 1e-9;
    if (on_lattice && std::fabs(X_SF.yaw) <= yaw) elements.push_back(i);
  }
  const SweptVolumeQuery query(*baked.cached.volumes, place.robot.sole_outline,
                               RestingPart(place.scene));
  const HalfStepCertifier certifier(place.robot, place.scene, config);
  PlanRequest request{.start = StartOf(config, place.robot, *place.scene.ground),
                      .goal = config.goal.Region(),
                      .set = set,
                      .query = query};
  request.start_is_free = [&](const HalfStep& up, const Foothold& X_WS) {
    return certifier.Certifies(up, X_WS);
  };
  if (const auto& w = config.planner.workspace; !w.empty()) {
    request.workspace = {Eigen::Vector2d(w[0], w[1]), Eigen::Vector2d(w[2], w[3])};
  }
  SampledTimes times(place, set, ClearanceOf(config, place.robot) + spare);
  Brute brute(request, elements, &times);
  const auto steps = brute.Run();
  const HalfStepShape shape = set.prototype.shape;
  const MarginEvaluator evaluator(place.robot, place.scene, config.smoothing.limits);
  const CertifiedFeasibility test(evaluator, config.smoothing.certification);
  const bool certified =
      steps && CertifyPlan(test, MakeSequence(request.start, *steps, set.prototype.via_lateral,
                                              shape, MotionModelOf(place.robot, shape)))
                   .accepted;
  double ends = 0.0;
  for (size_t j = 0; steps && j < steps->size(); ++j) {
    const Footstep& step = (*steps)[j];
    ends += 2.0 * step.duration + step.rest + step.rest_on_one_foot;
  }
  if (certified) {
    std::printf("%.1f %zu certified", ends, steps->size());
  } else {
    std::printf("none 0 %s", steps ? "refused" : "searched");
  }
  std::printf(" %zu states, %ld half-steps and rests, %zu elements\n", brute.states(),
              times.asked(), elements.size());
  for (size_t j = 0; steps && j < steps->size(); ++j) {
    const Footstep& step = (*steps)[j];
    std::printf("  - {foot: %s, x_m: %.3f, y_m: %.3f, rest_s: %.1f, rest_on_one_foot_s: %.1f}\n",
                std::string(Name(step.side)).c_str(), step.X_WF.x, step.X_WF.y, step.rest,
                step.rest_on_one_foot);
  }
  return 0;
}
