#include "experiments/run/footstep_search.h"

#include <algorithm>
#include <optional>

#include "experiments/run/certified_half_steps.h"
#include "experiments/run/failure_words.h"
#include "experiments/run/level_crossings.h"
#include "experiments/run/plan_inputs.h"
#include "experiments/run/sloping_tops.h"
#include "experiments/run/watched_query.h"
#include "planner/scene/scene_parts.h"
#include "planner/search/planners.h"
#include "wpg/check.h"

namespace halfstep {
namespace {

// What a config has to say beside the place seen from above, so that the ground gives the height
// back.
LevelChoice SaidInConfig(const Foothold& X_WF, const Place& place) {
  const Ground& ground = *place.scene.ground;
  const auto highest = ground.Standing(place.robot.sole_outline, X_WF.Planar());
  LevelChoice choice;
  if (!highest || highest->height != X_WF.height) choice.z = X_WF.height;
  const Foothold again = OnGround(ground, place.robot, X_WF.Planar(), "plan", choice);
  HALFSTEP_CHECK(again == X_WF,
                 "a sole at " << X_WF.height << " m, above " << again.height << " m");
  return choice;
}

FootstepConfig ToConfig(const Footstep& footstep, const Place& place) {
  FootstepConfig config;
  config.foot = Name(footstep.side);
  config.X_WF = footstep.X_WF.Planar();
  config.on = SaidInConfig(footstep.X_WF, place);
  if (footstep.rest > 0.0) config.rest = footstep.rest;
  if (footstep.rest_on_one_foot > 0.0) config.rest_on_one_foot = footstep.rest_on_one_foot;
  if (footstep.crouch) config.crouch = footstep.crouch, config.via_height = footstep.via_height;
  return config;
}

Termination StopOf(const PlannerConfig& config, bool in_time, const PlanningHooks& hooks) {
  std::vector<Termination> all = {OnRequest(hooks.stop), AfterNodes(config.max_nodes),
                                  AfterEffort(config.effort)};
  if (config.deadline > 0.0) {
    all.push_back(AtTime(SteadySeconds, SteadySeconds() + config.deadline));
  }
  all.push_back(config.Enough(in_time));
  return AnyOf(std::move(all));
}

// The config with the footsteps in place of its goal.
ExperimentConfig WithFootsteps(ExperimentConfig config, const std::array<Foothold, 2>& start,
                               const std::vector<Footstep>& footsteps, const Place& place) {
  config.has_goal = false;
  config.has_start = true;
  config.start_left = start[0].Planar();
  config.start_right = start[1].Planar();
  config.start_left_on = SaidInConfig(start[0], place);
  config.start_right_on = SaidInConfig(start[1], place);
  for (const Footstep& footstep : footsteps) {
    config.footsteps.push_back(ToConfig(footstep, place));
  }
  return config;
}

// Adds why there is no plan, as far as that can be seen.
void ExplainNoPlan(const Place& place, const MarginEvaluator& evaluator, PlannedWalk* walk) {
  PlanResult& plan = walk->plan;
  if (plan.status == PlanStatus::kStartBlocked) {
    plan.sentence += MissedInPlace(place.robot, place.scene, walk->config);
  }
  if (plan.status != PlanStatus::kInterrupted) walk->inputs = LookAtGoal(walk->config, evaluator);
  std::string looked;
  for (const std::string& sentence : walk->inputs) looked += sentence + "; ";
  plan.sentence = looked + plan.sentence;
}

void Say(const std::string& more, PlannedWalk* walk) {
  if (!more.empty()) walk->plan.sentence += "; " + more;
}

void Say(const Hindrance& found, PlannedWalk* walk) {
  Say(found.words, walk);
  if (found.in_the_way != nullptr) walk->in_the_way = found.in_the_way->name;
}

}  // namespace

Place Resting(const Place& place) { return {place.robot, RestingPart(place.scene)}; }

void SearchFootsteps(const FootstepSearch& search, const Place& place, const PlanningHooks& hooks,
                     PlannedWalk* walk) {
  const ExperimentConfig& config = walk->config;
  const Ground& ground = *place.scene.ground;
  const HalfStepCertifier certifier(place.robot, place.scene, config);
  const MarginEvaluator evaluator(place.robot, place.scene, config.smoothing.limits);
  const CertifiedFeasibility test(evaluator, config.smoothing.certification);
  const HalfStep prototype = PrototypeOf(config);

  const GoalRegion goal = GoalOn(config.goal, ground);
  const WatchedQuery watched(search.query, goal);
  std::optional<WatchedTimes> watched_times;
  if (search.times != nullptr) watched_times.emplace(*search.times, goal);
  PlanRequest request{.start = StartOf(config, place.robot, ground),
                      .goal = goal,
                      .set = search.set,
                      .query = watched,
                      .times = watched_times ? &*watched_times : nullptr,
                      .cost = config.planner.Cost(walk->in_time),
                      .ground = search.ground};
  if (HasLevels(ground) && !search.ground) {
    for (const GroundLevel& level : ground.Levels()) request.levels.push_back(level.height);
    std::ranges::sort(request.levels);
  }
  if (const auto& w = config.planner.workspace; !w.empty()) {
    request.workspace = {Eigen::Vector2d(w[0], w[1]), Eigen::Vector2d(w[2], w[3])};
  }
  request.start_is_free = [&](const HalfStep& up, const Foothold& X_WS) {
    return up.X_SF.height <= up.via_height && certifier.Certifies(up, X_WS);
  };
  request.accepts = [&](const std::vector<Footstep>& footsteps) {
    return CertifyPlan(
        test, MakeSequence(request.start, footsteps, prototype.via_lateral, prototype.shape,
                           MotionModelOf(place.robot, prototype.shape)));
  };
  request.max_refusals = config.planner.max_refusals;
  request.clock = SteadySeconds;
  request.stop = StopOf(config.planner, search.times != nullptr, hooks);
  request.proofs = [&search] {
    return (search.effort ? search.effort() : 0.0) +
           (search.times != nullptr ? search.times->effort() : 0.0);
  };
  std::mt19937_64 random(static_cast<std::uint64_t>(config.seed));
  const auto planner =
      config.planner.known.Make(config.planner.name, place.scene, config.planner.options);
  walk->plan = planner->Plan(request, random);
  walk->proof_effort += request.proofs();
  if (walk->plan.status == PlanStatus::kSolved) {
    if (search.volumes != nullptr) {
      const Hindrance detour =
          FindDetour(request, walk->plan, *search.volumes, place, evaluator.limits());
      walk->detour = detour.words;
      if (detour.in_the_way != nullptr) walk->in_the_way = detour.in_the_way->name;
    }
    walk->config = WithFootsteps(config, request.start, walk->plan.footsteps, place);
    return;
  }
  if (walk->plan.status == PlanStatus::kBudget || walk->plan.status == PlanStatus::kNoPlan) {
    Say(BudgetWords(config.planner, walk->plan, request.proofs()), walk);
    Say(NearestWords(watched, request), walk);
    if (search.volumes != nullptr) {
      const Place asked = walk->in_time ? Resting(place) : place;
      Say(FindBlocking(watched, *search.volumes, asked, evaluator.limits()), walk);
      if (watched_times) Say(MovingWords(*watched_times, *search.volumes, place), walk);
    }
    for (const std::string& slopes : SlopingTops(place.robot, place.scene, AreaOf(config, place))) {
      Say(slopes, walk);
    }
  }
  ExplainNoPlan(place, evaluator, walk);
}

}  // namespace halfstep
