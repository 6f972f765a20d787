#include "experiments/run/baked_half_steps.h"

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "experiments/config/experiment.h"
#include "experiments/run/certified_half_steps.h"
#include "experiments/run/missed_demands_text.h"
#include "smoothing/margins/demandable.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep {

double SteadySeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string MissedInPlace(const RobotModel& robot, const Scene& scene,
                          const ExperimentConfig& config) {
  const HalfStep prototype = PrototypeOf(config);
  const std::array<Foothold, 2> start = StartOf(config, robot, *scene.ground);
  const double higher = std::abs(start[0].height - start[1].height);
  if (higher > prototype.via_height) {
    return Formatted(
        "; one foot stands %.3g m higher than the other, and `half_step.via_height_m` "
        "is %.3g",
        higher, prototype.via_height);
  }
  const Footstep footstep{.side = Side::kLeft,
                          .X_WF = Nth(start, Index(Side::kLeft)),
                          .via_height = prototype.via_height,
                          .duration = prototype.duration};
  const HalfStepSequence sequence =
      MakeSequence(start, {footstep}, prototype.via_lateral, prototype.shape,
                   MotionModelOf(robot, prototype.shape));
  const MarginEvaluator evaluator(robot, scene, config.smoothing.limits);
  const CertifiedFeasibility test(evaluator, config.smoothing.certification);
  const SuperposedWalk walk(sequence, PlannedMotion(sequence));
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  const Feasibility answer = test.Check(walk, {0.0, walk.duration()}, &scratch);
  if (answer.verdict == Verdict::kFeasible) return "";
  std::string text = "; a step in place is not feasible either, worst first:\n  ";
  std::string separator;
  for (const std::string& line :
       MissedDemandsText(evaluator, sequence, FindMissedDemands(evaluator, walk, answer.witness))) {
    text += separator + line;
    separator = "\n  ";
  }
  return text;
}

[[noreturn]] void ThrowNoHalfStep(const RobotModel& robot, const ExperimentConfig& config) {
  throw InputError(
      {std::string("step_set: no place of the grid keeps the demanded margins (valid: a grid "
                   "beside the support foot, margins that the robot meets)") +
       MissedInPlace(robot, Scene{}, config)});
}

BakedHalfSteps BakeHalfSteps(const RobotModel& robot, const ExperimentConfig& config,
                             const PlanningHooks& hooks) {
  return BakeHalfSteps(robot, config, FlatGround(), hooks);
}

CachedVolumes BakeSet(const RobotModel& robot, const ExperimentConfig& config, const StepSet& set,
                      const PlanningHooks& hooks) {
  SweptVolumeOptions options = config.swept_volumes.options;
  const MarginLimits limits = Demandable(config.smoothing.limits, robot);
  // One distance for all bodies, as far as any of them may be from its place.
  options.clearance =
      limits.demanded_of(MarginFamily::kClearance) + TubeShift(robot, limits.tube).body;
  if (set.on_levels) {  // also the sole's while it moves over solids
    options.clearance = std::max(options.clearance, limits.demanded_of(MarginFamily::kFloor));
  }
  std::string folder = DefaultCacheFolder();
  if (!config.swept_volumes.cache.empty()) {
    folder = (std::filesystem::path(config.directory) / config.swept_volumes.cache).string();
  }
  const auto progress = [&hooks](double done) {
    if (hooks.progress) hooks.progress("bake", done);
    return !hooks.stop.stop_requested();
  };
  return LoadOrBakeSweptVolumes(robot, *MotionModelOf(robot, ShapeOf(config.half_step)), set,
                                options, folder,
                                {.threads = 0, .stop = hooks.stop, .progress = progress});
}

BakedHalfSteps BakeHalfSteps(const RobotModel& robot, const ExperimentConfig& config,
                             const Ground& ground, const PlanningHooks& hooks) {
  const auto progress = [&hooks](const char* what) {
    return [&hooks, what](double done) {
      if (hooks.progress) hooks.progress(what, done);
      return !hooks.stop.stop_requested();
    };
  };
  BakedHalfSteps baked;
  const double begin = SteadySeconds();
  const StepSet set = HasLevels(ground)
                          ? CertifiedHalfStepsOn(ground, robot, config, progress("half-steps"))
                          : CertifiedHalfSteps(robot, config, progress("half-steps"));
  const double set_done = SteadySeconds();
  baked.set_wall = set_done - begin;
  baked.size = set.size();
  if (hooks.stop.stop_requested()) return baked;
  if (set.size() == 0) ThrowNoHalfStep(robot, config);
  baked.cached = BakeSet(robot, config, set, hooks);
  baked.wall = SteadySeconds() - set_done;
  return baked;
}

}  // namespace halfstep
