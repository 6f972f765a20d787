// How the replanner searches for footsteps, and takes what it finds.

#include "experiments/live/near_rest.h"
#include "experiments/live/near_start_query.h"
#include "experiments/live/prepared_world.h"
#include "experiments/live/replanner.h"
#include "experiments/live/thread_seconds.h"
#include "experiments/run/planning.h"
#include "planner/search/planners.h"
#include "wpg/nth.h"

namespace halfstep {

PlanResult Replanner::Plan(const std::array<Foothold, 2>& stance,
                           const std::optional<StepState>& in_air, const PreparedWorld& among,
                           const GoalRegion& goal, const NearRest* near, bool rests,
                           std::int64_t max_nodes, std::mt19937_64& random) const {
  const bool by_volumes = half_steps_.volumes() != nullptr;
  const auto search = [&](const HalfStepQuery& query, std::int64_t nodes) {
    PlanResult found = Search(stance, in_air, among, goal, near, query, nodes, random);
    if (!by_volumes) found.nodes += found.queries;
    return found;
  };
  PlanResult result = search(*among.query, max_nodes);
  if (!rests || result.status != PlanStatus::kNoPlan || (!by_volumes && !near)) return result;
  // Where the robot rests near an obstacle, it may take more than one half-step to get away.
  const std::int64_t nodes = result.nodes;
  if (by_volumes) {
    const NearStartQuery query(half_steps_.set(), *among.query,
                               near ? near->certifier() : among.certifier,
                               MidFeet(stance[0].Planar(), stance[1].Planar()).position());
    result = search(query, max_nodes - nodes);
  } else {
    const auto query = half_steps_.Among(near->safety().evaluator().scene());
    result = search(*query, max_nodes - nodes);
  }
  result.nodes += nodes;
  return result;
}

PlanResult Replanner::Search(const std::array<Foothold, 2>& stance,
                             const std::optional<StepState>& in_air, const PreparedWorld& among,
                             const GoalRegion& goal, const NearRest* near,
                             const HalfStepQuery& query, std::int64_t max_nodes,
                             std::mt19937_64& random) const {
  const PlannerConfig& options = config_.experiment.planner;
  PlanRequest request = half_steps_.Request(query);
  request.start = stance;
  request.in_air = in_air;
  request.goal = goal;
  request.cost = options.Cost();
  if (const auto& w = options.workspace; !w.empty()) {
    request.workspace = {Eigen::Vector2d(w[0], w[1]), Eigen::Vector2d(w[2], w[3])};
  }
  request.start_is_free = [&](const HalfStep& up, const Foothold& X_WS) {
    return up.X_SF.height <= up.via_height &&
           (near ? near->certifier() : among.certifier).Certifies(up, X_WS);
  };
  // A proof takes longer than a node.
  const bool by_volumes = half_steps_.volumes() != nullptr;
  const auto used_up = [max_nodes, by_volumes](const PlanProgress& progress) {
    const std::int64_t proofs = by_volumes ? 0 : progress.queries;
    return progress.nodes + proofs >= max_nodes ? StopReason::kBudget : StopReason::kGoOn;
  };
  request.stop = AnyOf({used_up, options.Enough(false)});
  return options.known.Make(options.name, among.world.scene, options.options)
      ->Plan(request, random);
}

PlanResult Replanner::PlanAfter(const Situation& s, const WalkPlan& plan, int junction,
                                const PreparedWorld& among, const GoalRegion& goal,
                                const NearRest* near, std::mt19937_64& random,
                                Proposal* proposal) const {
  const double begin = ThreadSeconds();
  const auto& [half_step, X_WS, rest] = Nth(plan.sequence.half_steps, junction);
  std::optional<StepState> in_air;
  if (half_step.kind == HalfStepKind::kUp) in_air = {X_WS, half_step.support};
  const std::int64_t left = config_.experiment.planner.max_nodes - proposal->nodes;
  const std::array<Foothold, 2> stance = StanceAfter(plan.sequence, junction);
  // Other footsteps after another junction do not begin where the robot rests.
  const NearRest* from_rest = near && near->half_step() == junction + 1 ? near : nullptr;
  const bool rests =
      s.stopped || (junction + 1 == plan.sequence.size() && plan.Walk().duration() <= s.hand_over);
  PlanResult result = Plan(stance, in_air, among, goal, from_rest, rests, left, random);
  proposal->nodes += result.nodes;
  proposal->effort.plan += result.effort();
  proposal->planned = result;
  proposal->seconds.plan += ThreadSeconds() - begin;
  return result;
}

bool Replanner::Change(const Situation& s, const WalkPlan& plan, int junction,
                       const PreparedWorld& among, const NearRest* near, std::mt19937_64& random,
                       Proposal* proposal) const {
  const PlanResult result =
      PlanAfter(s, plan, junction, among, among.world.goal, near, random, proposal);
  if (result.status != PlanStatus::kSolved) return false;
  if (result.footsteps.empty() && junction % 2 == 0) return false;
  constexpr int kProvedAtOnce = 4;  // half-steps behind the junction
  if (Splice(s, plan, junction, result.footsteps, kProvedAtOnce, among, near, proposal)) {
    return false;
  }
  proposal->course = nullptr;
  return true;
}

}  // namespace halfstep
