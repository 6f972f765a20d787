#include "experiments/run/plan_by_volumes.h"

#include <limits>
#include <optional>

#include "experiments/run/certificate_query.h"
#include "experiments/run/certified_half_steps.h"
#include "experiments/run/crossing_query.h"
#include "experiments/run/footstep_search.h"
#include "planner/scene/scene_parts.h"
#include "planner/swept/obstacle_places.h"
#include "planner/swept/obstacle_times.h"
#include "planner/swept/swept_volume_query.h"
#include "smoothing/margins/demandable.h"
#include "smoothing/margins/tube_shift.h"

namespace halfstep {
namespace {

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

}  // namespace

double ClearanceOf(const ExperimentConfig& config, const RobotModel& robot) {
  const MarginLimits limits = Demandable(config.smoothing.limits, robot);
  return limits.demanded_of(MarginFamily::kClearance) + TubeShift(robot, limits.tube).body;
}

bool StartsOnNoStep(const Place& place, PlannedWalk* walk) {
  const auto on_area = FootholdOnNoStep({walk->config, place.robot, place.scene, {}});
  if (!on_area) return false;
  walk->plan.status = PlanStatus::kStartBlocked;
  walk->plan.sentence = *on_area;
  return true;
}

void PlanByVolumes(const Place& place, const PlanningHooks& hooks, PlannedWalk* walk,
                   const LedOver& over) {
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

}  // namespace halfstep
