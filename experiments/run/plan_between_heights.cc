#include "experiments/run/plan_between_heights.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "experiments/run/certified_half_steps.h"
#include "experiments/run/footstep_search.h"
#include "experiments/run/plan_by_volumes.h"
#include "planner/search/footstep_astar.h"
#include "planner/swept/swept_volume_query.h"
#include "smoothing/margins/demandable.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// Half-steps of `set`, with its places, that change the waist's height as said.
void AddBetween(const RobotModel& robot, const HalfStepCertifier& certifier, const StepSet& set,
                const StepSet::Change& change, StepSet* between) {
  for (const int i : ClassicSubset(set)) {
    between->placements.push_back(Nth(set.placements, i));
    between->changes.push_back(change);
    const HalfStep up = between->Up(between->size() - 1, Side::kLeft);
    if (certifier.Certifies(up, {}) &&
        (robot.legs_are_mirrored || certifier.Certifies(up.Mirrored(), {}))) {
      continue;
    }
    between->placements.pop_back();
    between->changes.pop_back();
  }
}

void Append(SweptVolumes&& more, const std::vector<StepSet::Change>& changes, SweptVolumes* all) {
  const auto append = [](auto& from, auto* to) {
    to->insert(to->end(), std::make_move_iterator(from.begin()),
               std::make_move_iterator(from.end()));
  };
  append(more.set.placements, &all->set.placements);
  all->set.changes.insert(all->set.changes.end(), changes.begin(), changes.end());
  append(more.down, &all->down);
  append(more.up, &all->up);
}

// One set of all, the config's first; without volumes when stopped or where the waist cannot change
// its height.
BakedHalfSteps Bake(const Place& place, const StepSet::Form& lower, const PlanningHooks& hooks,
                    const ExperimentConfig& config) {
  BakedHalfSteps baked = BakeHalfSteps(place.robot, config, hooks);
  if (!baked.cached.volumes) return baked;
  SweptVolumes& all = *baked.cached.volumes;
  const double begin = SteadySeconds();
  StepSet between{.prototype = all.set.prototype, .placements = {}};
  between.forms = {{all.set.prototype.shape.crouch, all.set.prototype.via_height}, lower};
  const StepSet low =
      CertifiedHalfSteps(place.robot, config, between.PrototypeOf(1), [&hooks](double done) {
        if (hooks.progress) hooks.progress("half-steps", done);
        return !hooks.stop.stop_requested();
      });
  const HalfStepCertifier certifier(place.robot, Scene{}, config);
  if (low.size() > 0) {
    AddBetween(place.robot, certifier, all.set, {0, 1}, &between);
    AddBetween(place.robot, certifier, low, {1, 0}, &between);
  }
  const double set_done = SteadySeconds();
  baked.set_wall += set_done - begin;
  baked.size = all.set.size() + low.size() + between.size();
  CachedVolumes low_volumes, between_volumes;
  if (between.size() > 0) {
    low_volumes = BakeSet(place.robot, config, low, hooks);
    if (low_volumes.volumes) between_volumes = BakeSet(place.robot, config, between, hooks);
  }
  baked.wall += SteadySeconds() - set_done;
  if (!between_volumes.volumes) {
    baked.cached.volumes.reset();
    return baked;
  }
  all.set.forms = between.forms;
  all.set.changes.assign(all.set.placements.size(), {0, 0});
  Append(std::move(*low_volumes.volumes),
         std::vector<StepSet::Change>(low.placements.size(), {1, 1}), &all);
  Append(std::move(*between_volumes.volumes), between.changes, &all);
  return baked;
}

}  // namespace

void PlanBetweenHeights(const Place& place, const StepSet::Form& lower, const PlanningHooks& hooks,
                        PlannedWalk* walk) {
  walk->half_steps = Bake(place, lower, hooks, walk->config);
  if (!walk->half_steps.cached.volumes) {
    const bool stopped = hooks.stop.stop_requested();
    walk->plan.status = stopped ? PlanStatus::kInterrupted : PlanStatus::kNoPlan;
    walk->plan.sentence = stopped
                              ? "interrupted while half-steps were baked"
                              : "no half-step is certified in which the waist changes its height";
    return;
  }
  if (StartsOnNoStep(place, walk)) return;
  const SweptVolumes& volumes = *walk->half_steps.cached.volumes;
  const MarginLimits limits = Demandable(walk->config.smoothing.limits, place.robot);
  const SweptVolumeQuery query(
      volumes, place.robot.sole_outline, place.scene, limits.demanded_of(MarginFamily::kNoStep),
      std::numeric_limits<double>::infinity(), limits.demanded_of(MarginFamily::kFoothold));
  SearchFootsteps({.set = volumes.set, .query = query, .volumes = &volumes}, place, hooks, walk);
}

bool ChangesHeight(const PlannedWalk& walk) {
  return std::ranges::any_of(walk.plan.footsteps, [&walk](const Footstep& footstep) {
    return footstep.crouch && *footstep.crouch != walk.config.half_step.crouch;
  });
}

}  // namespace halfstep
