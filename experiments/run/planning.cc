#include "experiments/run/planning.h"

#include <algorithm>

#include "experiments/run/certificate_query.h"
#include "experiments/run/crouched_forms.h"
#include "experiments/run/footstep_search.h"
#include "experiments/run/ground_steps.h"
#include "experiments/run/half_step_forms.h"
#include "experiments/run/half_step_table.h"
#include "experiments/run/level_crossings.h"
#include "experiments/run/narrow_surfaces.h"
#include "experiments/run/plan_between_heights.h"
#include "experiments/run/plan_by_volumes.h"
#include "experiments/run/plan_inputs.h"
#include "experiments/run/plan_over.h"
#include "planner/search/planners.h"
#include "planner/swept/obstacle_places.h"
#include "planner/swept/obstacle_times.h"
#include "smoothing/margins/demandable.h"
#include "smoothing/margins/not_covered_by.h"
#include "wpg/check.h"
#include "wpg/files/input_error.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep {

Acceptance CertifyPlan(const CertifiedFeasibility& test, const HalfStepSequence& sequence) {
  const SuperposedWalk walk(sequence, PlannedMotion(sequence));
  MarginEvaluator::Scratch scratch = test.evaluator().MakeScratch();
  const Feasibility answer = test.Check(walk, {0.0, walk.duration()}, &scratch);
  if (answer.verdict == Verdict::kFeasible) return true;
  // Element j serves half-steps 2j + 1, down, and 2j + 2, up.
  return {false, std::max(0, (answer.witness.at.half_step - 1) / 2)};
}

namespace {

// Whether obstacles that move count only where they are at the time. Throws InputError where that
// was asked for and the planner cannot.
bool PlansInTime(const PlannerConfig& config, const Scene& scene, const FootstepPlanner& planner) {
  if (!AnythingMoves(scene) || config.moving == "everywhere") return false;
  const bool same_cost = config.Cost(true).kind != CostKind::kSmoothedDuration;
  if (config.moving == "in_time" && !planner.knows_time()) {
    throw InputError({"planner.moving: " + Quote(config.name) +
                      " does not know when obstacles are where (valid: everywhere, or " +
                      "`planner.name: best`)"});
  }
  if (config.moving == "in_time" && !same_cost) {
    throw InputError({"planner.cost: " + Quote(config.cost) +
                      " is an estimate, and plans in time take raw half-steps at their times "
                      "(valid: steps, raw_duration)"});
  }
  return planner.knows_time() && same_cost;
}

// Whether half-steps are called free by their proofs.
bool ByCertificates(const ExperimentConfig& config, const Scene& scene, bool in_time) {
  if (!config.planner.free_by.empty()) return config.planner.free_by == "certificates";
  return HasLevels(*scene.ground) && (in_time || !AnythingMoves(scene));
}

// With half-steps of one form that are called free by their proofs. In time `resting` is the place
// without what moves; else it is the place.
void PlanByCertificates(const Place& place, const Place& resting, const PlanningHooks& hooks,
                        PlannedWalk* walk) {
  const double begin = SteadySeconds();
  const StepSet set = StepsByGround(place.robot, walk->config);
  walk->half_steps.size = set.size();
  walk->half_steps.set_wall += SteadySeconds() - begin;
  if (set.size() == 0) ThrowNoHalfStep(place.robot, walk->config);
  const CertificateQuery query(
      set, MarginEvaluator(place.robot, resting.scene, walk->config.smoothing.limits),
      walk->config.smoothing.certification);
  std::optional<ObstacleTimes> times;
  if (walk->in_time) {
    times.emplace(place.robot, MotionModelOf(place.robot, set.prototype.shape), set, place.scene,
                  ClearanceOf(walk->config, place.robot));
  }
  SearchFootsteps(
      {.set = set,
       .query = query,
       .ground = [&query](const Pose2& X_WF, double from) { return query.HeightAt(X_WF, from); },
       .effort = [&query] { return query.work().effort(); },
       .times = times ? &*times : nullptr},
      place, hooks, walk);
}

// The same with the first form that has a plan.
void PlanByForms(const Place& place, const PlanningHooks& hooks, PlannedWalk* walk) {
  constexpr int kMost = 3;
  if (StartsOnNoStep(place, walk)) return;
  const Place resting = walk->in_time ? Resting(place) : place;
  const ExperimentConfig config = walk->config;
  HalfStepForms found;
  for (int i = 0; i < kMost && !hooks.stop.stop_requested(); ++i) {
    if (i < 2) {  // others are looked for when the first one has no plan
      const double begin = SteadySeconds();
      found = FormsFor(config, resting, i == 0 ? 1 : kMost);
      walk->half_steps.set_wall += SteadySeconds() - begin;
    }
    if (i == std::ssize(found.forms)) break;
    const HalfStepConfig& form = Nth(found.forms, i);
    walk->config = config;
    walk->config.half_step = form;
    if (found.on_levels) walk->config.planner.effort = config.planner.effort / kMost;
    PlanByCertificates(place, resting, hooks, walk);
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

// By volumes. Where that finds nothing and something hangs so low that the standing robot does not
// pass, while a lower one might, it is searched with half-steps that are crouched all the way; that
// first, where what hangs bars every way. At last with half-steps at both heights of the waist.
void PlanUprightOrCrouched(const Place& place, const PlanningHooks& hooks, PlannedWalk* walk) {
  const Overhead overhead(walk->config, place);
  if (!overhead.may_help()) return PlanByVolumes(place, hooks, walk);
  PlannedWalk asked = *walk, upright = *walk;
  const double effort = walk->config.planner.effort;
  asked.config.planner.effort = 0.5 * effort;
  const auto plan_with = [&](const HalfStepConfig& half_step) {
    PlannedWalk planned = asked;
    planned.config.half_step = half_step;
    PlanByVolumes(place, hooks, &planned);
    planned.config.planner.effort = effort;
    return planned;
  };
  const auto plan_between = [&](const HalfStepConfig& lower) {
    PlannedWalk planned = asked;
    PlanBetweenHeights(place, {lower.crouch, lower.via_height}, hooks, &planned);
    planned.config.planner.effort = effort;
    return planned;
  };
  const auto has_ended = [](const PlannedWalk& planned) {
    return planned.plan.status == PlanStatus::kSolved ||
           planned.plan.status == PlanStatus::kInterrupted;
  };
  const HalfStepConfig& own = asked.config.half_step;
  const bool crouched_first = overhead.Bars();
  if (!crouched_first) {
    *walk = upright = plan_with(own);
    if (has_ended(upright)) return;
  }
  const std::vector<CrouchedForm> forms = overhead.Forms();
  std::string tried;
  for (const CrouchedForm& form : forms) {
    *walk = plan_with(form.half_step);
    if (walk->plan.status == PlanStatus::kSolved) {
      walk->changed_half_step = Differences(form.half_step, own);
      walk->plan.sentence += ", half_step: {" + walk->changed_half_step +
                             "} from the first to the last, since " + form.reason;
    }
    if (has_ended(*walk)) return;
    tried += "; nor is there a plan with half_step: {" + Differences(form.half_step, own) + "}";
  }
  if (crouched_first) upright = plan_with(own);
  *walk = std::move(upright);
  if (has_ended(*walk)) return;
  for (const CrouchedForm& form : forms) {
    PlannedWalk between = plan_between(form.half_step);
    const std::string lower = Differences(form.half_step, own);
    if (between.plan.status == PlanStatus::kSolved) {
      const auto low = std::ranges::count_if(between.plan.footsteps, [&](const Footstep& footstep) {
        return footstep.crouch == form.half_step.crouch;
      });
      between.plan.sentence +=
          Formatted(", %td of them with {", low) + lower + "}, since " + form.reason;
    }
    if (has_ended(between)) {
      *walk = std::move(between);
      return;
    }
    tried += ", nor one that changes between that and the config's";
  }
  walk->plan.sentence +=
      forms.empty() ? "; no half-step is certified that is crouched enough" : tried;
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
  const bool in_time = PlansInTime(config.planner, place.scene, *planner);
  const bool by_certificates = ByCertificates(config, place.scene, in_time);
  if (by_certificates && !in_time && AnythingMoves(place.scene)) {
    throw InputError(
        {"planner.free_by: a proof of a half-step by itself does not say when it is "
         "executed, and obstacles of the scene move (valid: volumes, or planning in time)"});
  }
  PlannedWalk walk{.config = config,
                   .plan = {},
                   .half_steps = {},
                   .on_levels = HasLevels(ground),
                   .in_time = in_time,
                   .not_covered = NotCoveredBy(place.robot, place.scene, config.smoothing.limits)};
  if (by_certificates) {
    PlanByForms(place, hooks, &walk);
  } else {
    walk.in_time || walk.on_levels ? PlanByVolumes(place, hooks, &walk)
                                   : PlanUprightOrCrouched(place, hooks, &walk);
    const bool may_prove = in_time || !AnythingMoves(place.scene);
    const bool upright = walk.changed_half_step.empty();
    if (!walk.in_the_way.empty() && upright && !ChangesHeight(walk) && !walk.on_levels &&
        may_prove) {
      PlanOver(config, place, hooks, &walk);
    }
  }
  return walk;
}

}  // namespace halfstep
