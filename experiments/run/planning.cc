#include "experiments/run/planning.h"

#include <algorithm>
#include <limits>

#include "experiments/run/certificate_query.h"
#include "experiments/run/failure_words.h"
#include "experiments/run/ground_steps.h"
#include "experiments/run/half_step_forms.h"
#include "experiments/run/half_step_table.h"
#include "experiments/run/level_crossings.h"
#include "experiments/run/narrow_surfaces.h"
#include "experiments/run/plan_inputs.h"
#include "experiments/run/watched_query.h"
#include "planner/search/planners.h"
#include "planner/swept/obstacle_places.h"
#include "planner/swept/swept_volume_query.h"
#include "smoothing/margins/demandable.h"
#include "smoothing/margins/not_covered_by.h"
#include "wpg/check.h"
#include "wpg/files/input_error.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

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
  return config;
}

Termination StopOf(const PlannerConfig& config, const PlanningHooks& hooks) {
  std::vector<Termination> all = {OnRequest(hooks.stop), AfterNodes(config.max_nodes),
                                  AfterEffort(config.effort)};
  if (config.deadline > 0.0) {
    all.push_back(AtTime(SteadySeconds, SteadySeconds() + config.deadline));
  }
  all.push_back(config.Enough());
  return AnyOf(std::move(all));
}

}  // namespace

Acceptance CertifyPlan(const CertifiedFeasibility& test, const HalfStepSequence& sequence) {
  const SuperposedWalk walk(sequence, PlannedMotion(sequence));
  MarginEvaluator::Scratch scratch = test.evaluator().MakeScratch();
  const Feasibility answer = test.Check(walk, {0.0, walk.duration()}, &scratch);
  if (answer.verdict == Verdict::kFeasible) return true;
  // Element j serves half-steps 2j + 1, down, and 2j + 2, up.
  return {false, std::max(0, (answer.witness.at.half_step - 1) / 2)};
}

namespace {

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

// Whether half-steps are called free by their proofs.
bool ByCertificates(const ExperimentConfig& config, const Scene& scene) {
  if (!config.planner.free_by.empty()) return config.planner.free_by == "certificates";
  return HasLevels(*scene.ground) && !AnythingMoves(scene);
}

// A search, with what differs between what says that half-steps are free.
struct Search {
  const StepSet& set;
  const HalfStepQuery& query;
  std::function<double(const Pose2&, double)> ground = {};  // as in PlanRequest
  std::function<double()> effort = {};                      // of the query; empty: as is counted
  const SweptVolumes* volumes = nullptr;                    // of the query, if it asks these
};

void Say(const std::string& more, PlannedWalk* walk) {
  if (!more.empty()) walk->plan.sentence += "; " + more;
}

// Plans with walk->config and writes into it.
void SearchWith(const Search& search, const Place& place, const PlanningHooks& hooks,
                PlannedWalk* walk) {
  const ExperimentConfig& config = walk->config;
  const Ground& ground = *place.scene.ground;
  const HalfStepCertifier certifier(place.robot, place.scene, config);
  const MarginEvaluator evaluator(place.robot, place.scene, config.smoothing.limits);
  const CertifiedFeasibility test(evaluator, config.smoothing.certification);
  const HalfStep prototype = PrototypeOf(config);

  const GoalRegion goal = GoalOn(config.goal, ground);
  const WatchedQuery watched(search.query, goal);
  PlanRequest request{.start = StartOf(config, place.robot, ground),
                      .goal = goal,
                      .set = search.set,
                      .query = watched,
                      .cost = config.planner.Cost(),
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
  request.proofs = search.effort;
  request.stop = StopOf(config.planner, hooks);
  std::mt19937_64 random(static_cast<std::uint64_t>(config.seed));
  const auto planner =
      config.planner.known.Make(config.planner.name, place.scene, config.planner.options);
  walk->plan = planner->Plan(request, random);
  if (search.effort) walk->proof_effort += search.effort();
  if (walk->plan.status == PlanStatus::kSolved) {
    if (search.volumes != nullptr) {
      Say(DetourWords(request, walk->plan, *search.volumes, place, evaluator.limits()), walk);
    }
    walk->config = WithFootsteps(config, request.start, walk->plan.footsteps, place);
    return;
  }
  if (walk->plan.status == PlanStatus::kBudget || walk->plan.status == PlanStatus::kNoPlan) {
    Say(BudgetWords(config.planner, walk->plan, search.effort ? search.effort() : 0.0), walk);
    Say(NearestWords(watched, request), walk);
    if (search.volumes != nullptr) {
      Say(BlockingWords(watched, *search.volumes, place, evaluator.limits()), walk);
    }
  }
  ExplainNoPlan(place, evaluator, walk);
}

// Whether a foot starts where none may stand; then the walk says so.
bool StartsOnNoStep(const Place& place, PlannedWalk* walk) {
  const auto on_area = FootholdOnNoStep({walk->config, place.robot, place.scene, {}});
  if (!on_area) return false;
  walk->plan.status = PlanStatus::kStartBlocked;
  walk->plan.sentence = *on_area;
  return true;
}

// With half-steps of one form that are called free by their proofs.
void PlanByCertificates(const Place& place, const PlanningHooks& hooks, PlannedWalk* walk) {
  const double begin = SteadySeconds();
  const StepSet set = StepsByGround(place.robot, walk->config);
  walk->half_steps.size = set.size();
  walk->half_steps.set_wall += SteadySeconds() - begin;
  if (set.size() == 0) ThrowNoHalfStep(place.robot, walk->config);
  const CertificateQuery query(
      set, MarginEvaluator(place.robot, place.scene, walk->config.smoothing.limits),
      walk->config.smoothing.certification);
  SearchWith(
      {.set = set,
       .query = query,
       .ground = [&query](const Pose2& X_WF, double from) { return query.HeightAt(X_WF, from); },
       .effort = [&query] { return query.work().effort(); }},
      place, hooks, walk);
}

// The same with the first form that has a plan.
void PlanByForms(const Place& place, const PlanningHooks& hooks, PlannedWalk* walk) {
  constexpr int kMost = 3;
  if (StartsOnNoStep(place, walk)) return;
  const ExperimentConfig config = walk->config;
  HalfStepForms found;
  for (int i = 0; i < kMost && !hooks.stop.stop_requested(); ++i) {
    if (i < 2) {  // others are looked for when the first one has no plan
      const double begin = SteadySeconds();
      found = FormsFor(config, place, i == 0 ? 1 : kMost);
      walk->half_steps.set_wall += SteadySeconds() - begin;
    }
    if (i == std::ssize(found.forms)) break;
    const HalfStepConfig& form = Nth(found.forms, i);
    walk->config = config;
    walk->config.half_step = form;
    if (found.on_levels) walk->config.planner.effort = config.planner.effort / kMost;
    PlanByCertificates(place, hooks, walk);
    walk->config.planner.effort = config.planner.effort;
    if (walk->plan.status == PlanStatus::kSolved) {
      walk->changed_half_step = Differences(form, config.half_step);
      if (!walk->changed_half_step.empty()) {
        walk->plan.sentence += ", half_step: {" + walk->changed_half_step + "}";
      }
      return;
    }
  }
  if (walk->plan.status == PlanStatus::kInterrupted) return;
  for (const std::string& sentence : found.too_high) walk->plan.sentence += "; " + sentence;
  const double foothold =
      Demandable(config.smoothing.limits, place.robot).demanded_of(MarginFamily::kFoothold);
  for (const std::string& sentence :
       NarrowSurfaces(place.robot, *place.scene.ground, foothold, AreaOf(config, place))) {
    walk->plan.sentence += "; " + sentence;
  }
}

// With half-steps that are called free by their swept volumes.
void PlanByVolumes(const Place& place, const PlanningHooks& hooks, PlannedWalk* walk) {
  walk->half_steps = BakeHalfSteps(place.robot, walk->config, *place.scene.ground, hooks);
  if (!walk->half_steps.cached.volumes) {
    walk->plan.status = PlanStatus::kInterrupted;
    walk->plan.sentence = "interrupted while half-steps were baked";
    return;
  }
  if (StartsOnNoStep(place, walk)) return;
  const SweptVolumes& volumes = *walk->half_steps.cached.volumes;
  const MarginLimits limits = Demandable(walk->config.smoothing.limits, place.robot);
  const SweptVolumeQuery query(
      volumes, place.robot.sole_outline, place.scene, limits.demanded_of(MarginFamily::kNoStep),
      std::numeric_limits<double>::infinity(), limits.demanded_of(MarginFamily::kFoothold));
  SearchWith({.set = volumes.set, .query = query, .volumes = &volumes}, place, hooks, walk);
}

}  // namespace

PlannedWalk PlanWalk(const ExperimentConfig& config, const Place& place,
                     const PlanningHooks& hooks) {
  HALFSTEP_CHECK(config.has_goal, "no goal");
  CheckPlaces(place.scene);  // before minutes of baking
  const Ground& ground = *place.scene.ground;
  const auto planner =
      config.planner.known.Make(config.planner.name, place.scene, config.planner.options);
  if (HasLevels(ground) && !planner->knows_levels()) {
    throw InputError({"planner.name: " + Quote(config.planner.name) +
                      " plans at one height only, and the scene's ground has levels (valid: best, "
                      "rrt, astar, astar/classic)"});
  }
  GoalOn(config.goal, ground);  // complains before anything is computed
  const bool by_certificates = ByCertificates(config, place.scene);
  if (by_certificates && AnythingMoves(place.scene)) {
    throw InputError(
        {"planner.free_by: a proof of a half-step by itself does not say when it is "
         "executed, and obstacles of the scene move (valid: volumes)"});
  }
  PlannedWalk walk{.config = config,
                   .plan = {},
                   .half_steps = {},
                   .on_levels = HasLevels(ground),
                   .not_covered = NotCoveredBy(place.robot, place.scene, config.smoothing.limits)};
  if (by_certificates) {
    PlanByForms(place, hooks, &walk);
  } else {
    PlanByVolumes(place, hooks, &walk);
  }
  return walk;
}

}  // namespace halfstep
