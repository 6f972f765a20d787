#include "experiments/run/plan_over.h"

#include <algorithm>

#include "experiments/run/ground_steps.h"
#include "experiments/run/half_step_forms.h"
#include "experiments/run/half_step_table.h"
#include "experiments/run/plan_by_volumes.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"
#include "wpg/robot/robot_measures.h"

namespace halfstep {
namespace {

// What half-steps that rise to a height may lead over: what is lower than that and as narrow as a
// leg is long.
std::vector<ObstacleFootprint> LowOnes(const Place& place, double via_height) {
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

}  // namespace

void PlanOver(const ExperimentConfig& config, const Place& place, const PlanningHooks& hooks,
              PlannedWalk* walk) {
  if (hooks.stop.stop_requested()) return;
  const auto obstacle = std::ranges::find(place.scene.obstacles, walk->in_the_way, &Obstacle::name);
  const std::string name = Quote(walk->in_the_way);
  const bool solved = walk->plan.status == PlanStatus::kSolved;
  std::string* const said = solved ? &walk->detour : &walk->plan.sentence;
  const std::array<Foothold, 2> start = StartOf(config, place.robot, *place.scene.ground);
  const StepSet all = MakeStepSet(config.step_set, {}, [](const HalfStep&) { return true; });
  std::string first, missed;
  for (const bool denser : {false, true}) {
    FormOver over = FindFormOver(config, place.robot, *obstacle,
                                 denser ? PlacesOf(config.step_set) : all.placements);
    walk->proof_effort += over.effort;
    if (!over.form) {
      missed = over.missed;
      continue;
    }
    if (first.empty()) first = Differences(*over.form, config.half_step);
    if (!denser) over.landings.clear();  // the set has them
    PlannedWalk other{.config = config,
                      .plan = {},
                      .half_steps = {},
                      .in_time = walk->in_time,
                      .not_covered = walk->not_covered};
    other.config.half_step = *over.form;
    try {
      PlanByVolumes(place, hooks, &other, {LowOnes(place, over.form->via_height), over.landings});
    } catch (const InputError&) {  // the config's step_set has no half-step of this form
      continue;
    }
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
    other.changed_half_step = Differences(*over.form, config.half_step);
    if (leads_over) other.detour = "";
    other.plan.sentence +=
        (leads_over ? ", over " + name : "") + " with half_step: {" + other.changed_half_step + "}";
    *walk = std::move(other);
    return;
  }
  if (said->empty()) return;
  if (!first.empty()) {
    *said += "; with half-steps that lead over it (half_step: {" + first + "}) no " +
             (solved ? "better " : "") + "plan was found";
  } else if (!missed.empty()) {
    *said += "; no other half-step that was tried leads over it: " + missed;
  }
}

}  // namespace halfstep
