#include "experiments/run/planning.h"

#include <algorithm>
#include <limits>

#include "experiments/run/certificate_query.h"
#include "experiments/run/certified_half_steps.h"
#include "experiments/run/crossing_query.h"
#include "experiments/run/footstep_search.h"
#include "experiments/run/ground_steps.h"
#include "experiments/run/half_step_forms.h"
#include "experiments/run/half_step_table.h"
#include "experiments/run/level_crossings.h"
#include "experiments/run/narrow_surfaces.h"
#include "experiments/run/plan_inputs.h"
#include "planner/search/planners.h"
#include "planner/swept/obstacle_places.h"
#include "planner/swept/obstacle_times.h"
#include "planner/swept/swept_volume_query.h"
#include "smoothing/margins/demandable.h"
#include "smoothing/margins/not_covered_by.h"
#include "smoothing/margins/tube_shift.h"
#include "wpg/check.h"
#include "wpg/files/input_error.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"
#include "wpg/robot/robot_measures.h"

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

// How far half-steps keep off obstacles [m]: each body as far as any of them may be from its place.
double ClearanceOf(const ExperimentConfig& config, const RobotModel& robot) {
  const MarginLimits limits = Demandable(config.smoothing.limits, robot);
  return limits.demanded_of(MarginFamily::kClearance) + TubeShift(robot, limits.tube).body;
}

// Whether a foot starts where none may stand; then the walk says so.
bool StartsOnNoStep(const Place& place, PlannedWalk* walk) {
  const auto on_area = FootholdOnNoStep({walk->config, place.robot, place.scene, {}});
  if (!on_area) return false;
  walk->plan.status = PlanStatus::kStartBlocked;
  walk->plan.sentence = *on_area;
  return true;
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

// What half-steps may lead over, and landings that do so, which have no volume.
struct Over {
  std::vector<ObstacleFootprint> obstacles;
  std::vector<Foothold> landings;
};

// Adds those that are certified on an empty floor, without volumes.
void AddLandings(const std::vector<Foothold>& landings, const RobotModel& robot,
                 const ExperimentConfig& config, SweptVolumes* volumes) {
  const HalfStepCertifier certifier(robot, Scene{}, config);
  const auto keeps = [&](const HalfStep& half_step) {
    return certifier.Certifies(half_step, {}) &&
           (robot.legs_are_mirrored || certifier.Certifies(half_step.Mirrored(), {}));
  };
  for (const Foothold& X_SF : landings) {
    StepSet one{.prototype = volumes->set.prototype, .placements = {X_SF}};
    if (!keeps(one.Down(0, Side::kLeft)) || !keeps(one.Up(0, Side::kLeft))) continue;
    volumes->set.placements.push_back(X_SF);
    volumes->down.emplace_back();
    volumes->up.emplace_back();
  }
}

// With half-steps that are called free by their swept volumes, and, where they lead over something,
// else by their proofs.
void PlanByVolumes(const Place& place, const PlanningHooks& hooks, PlannedWalk* walk,
                   const Over& over = {}) {
  walk->half_steps = BakeHalfSteps(place.robot, walk->config, *place.scene.ground, hooks);
  if (!walk->half_steps.cached.volumes) {
    walk->plan.status = PlanStatus::kInterrupted;
    walk->plan.sentence = "interrupted while half-steps were baked";
    return;
  }
  if (StartsOnNoStep(place, walk)) return;
  SweptVolumes& volumes = *walk->half_steps.cached.volumes;
  AddLandings(over.landings, place.robot, walk->config, &volumes);
  walk->half_steps.size = volumes.set.size();
  const MarginLimits limits = Demandable(walk->config.smoothing.limits, place.robot);
  const auto query_on = [&](const Scene& scene) {
    return SweptVolumeQuery(
        volumes, place.robot.sole_outline, scene, limits.demanded_of(MarginFamily::kNoStep),
        std::numeric_limits<double>::infinity(), limits.demanded_of(MarginFamily::kFoothold));
  };
  const Place resting = walk->in_time ? Resting(place) : place;
  const SweptVolumeQuery query = query_on(resting.scene);
  std::optional<SweptVolumeQuery> always;
  std::optional<ObstacleTimes> times;
  if (walk->in_time) {
    always.emplace(query_on(MovingPart(place.scene)));
    times.emplace(place.robot, MotionModelOf(place.robot, volumes.set.prototype.shape), volumes.set,
                  place.scene, ClearanceOf(walk->config, place.robot), &*always);
  }
  const FootstepSearch search{
      .set = volumes.set, .query = query, .times = times ? &*times : nullptr, .volumes = &volumes};
  if (over.obstacles.empty()) return SearchFootsteps(search, place, hooks, walk);
  // All else is certified of the set.
  const CertificateQuery proofs(
      volumes.set, MarginEvaluator(place.robot, resting.scene, walk->config.smoothing.limits),
      walk->config.smoothing.certification, {MarginFamily::kClearance, MarginFamily::kNoStep});
  const CrossingQuery crossing(query, proofs, volumes.set, place.robot.sole_outline,
                               over.obstacles);
  SearchFootsteps({.set = volumes.set,
                   .query = crossing,
                   .effort = [&proofs] { return proofs.work().effort(); },
                   .times = search.times,
                   .volumes = &volumes},
                  place, hooks, walk);
}

// What half-steps that rise to a height may lead over: what is lower than that and as narrow as a
// leg is long.
std::vector<ObstacleFootprint> LedOver(const Place& place, double via_height) {
  constexpr size_t kMost = 200;
  std::vector<ObstacleFootprint> over;
  for (const Obstacle& obstacle : place.scene.obstacles) {
    if (over.size() == kMost) break;
    if (!obstacle.rests()) continue;
    const ObstacleFootprint print = FootprintOf(obstacle);
    if (print.top < via_height && print.depth() < LegLengthOf(place.robot)) over.push_back(print);
  }
  return over;
}

// Whether a plan leads over an obstacle.
bool LeadsOver(const ObstacleFootprint& print, const std::array<Foothold, 2>& start,
               const std::vector<Footstep>& footsteps) {
  std::array<Foothold, 2> feet = start;
  return std::ranges::any_of(footsteps, [&](const Footstep& footstep) {
    Nth(feet, Index(footstep.side)) = footstep.X_WF;
    return print.IsBetween(feet[0].Planar().position(), feet[1].Planar().position());
  });
}

// Where no half-step of the set leads over what is in the way, plans with a set of another form
// that does: the cheaper plan stays.
void PlanOver(const ExperimentConfig& config, const Place& place, const PlanningHooks& hooks,
              PlannedWalk* walk) {
  const auto obstacle = std::ranges::find(place.scene.obstacles, walk->in_the_way, &Obstacle::name);
  const std::string name = Quote(walk->in_the_way);
  const bool solved = walk->plan.status == PlanStatus::kSolved;
  std::string* const said = solved ? &walk->detour : &walk->plan.sentence;
  const std::array<Foothold, 2> start = StartOf(config, place.robot, *place.scene.ground);
  const FormsOverObstacle found = FormsOver(config, place.robot, *obstacle);
  walk->proof_effort += found.effort;
  if (found.forms.empty()) {
    if (!said->empty() && !found.missed.empty()) {
      *said += "; no other half-step that was tried leads over it: " + found.missed;
    }
    return;
  }
  for (const FormOver& form : found.forms) {
    PlannedWalk other{.config = config,
                      .plan = {},
                      .half_steps = {},
                      .in_time = walk->in_time,
                      .not_covered = walk->not_covered};
    other.config.half_step = form.form;
    PlanByVolumes(place, hooks, &other, {LedOver(place, form.form.via_height), form.landings});
    if (hooks.stop.stop_requested()) return;
    const double effort = other.plan.effort() + other.proof_effort;
    const bool solves = other.plan.status == PlanStatus::kSolved;
    const bool leads_over =
        solves && LeadsOver(FootprintOf(*obstacle), start, other.plan.footsteps);
    if (!(solved ? leads_over && other.plan.cost < walk->plan.cost : solves)) {
      walk->proof_effort += effort;
      continue;
    }
    other.proof_effort += walk->plan.effort() + walk->proof_effort;
    other.half_steps.set_wall += walk->half_steps.set_wall;
    other.half_steps.wall += walk->half_steps.wall;
    other.changed_half_step = Differences(form.form, config.half_step);
    if (leads_over) other.detour = "";
    other.plan.sentence +=
        (leads_over ? ", over " + name : "") + " with half_step: {" + other.changed_half_step + "}";
    *walk = std::move(other);
    return;
  }
  if (said->empty()) return;
  *said += "; with half-steps that lead over it (half_step: {" +
           Differences(found.forms.front().form, config.half_step) + "}) no " +
           (solved ? "better " : "") + "plan was found";
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
    PlanByVolumes(place, hooks, &walk);
    const bool may_prove = in_time || !AnythingMoves(place.scene);
    if (!walk.in_the_way.empty() && !walk.on_levels && may_prove) {
      PlanOver(config, place, hooks, &walk);
    }
  }
  return walk;
}

}  // namespace halfstep
