#pragma once

#include <functional>
#include <stop_token>
#include <string>

#include "experiments/config/experiment_config.h"
#include "planner/scene/scene.h"
#include "planner/swept/swept_volume_cache.h"
#include "wpg/ground/ground.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// Seconds of a steady clock.
double SteadySeconds();

/// Callbacks of planning. `progress` is called with what is under way and the fraction of it that
/// is done.
struct PlanningHooks {
  std::function<void(const std::string& what, double done)> progress = {};  ///< may be empty
  std::stop_token stop = {};  ///< ends planning; the best plan so far is kept
};

/// The set and its swept volumes, from the cache or baked. Throws InputError when no half-step is
/// certified.
struct BakedHalfSteps {
  int size = 0;           ///< elements
  double set_wall = 0.0;  ///< of certifying the set [s]
  double wall = 0.0;      ///< of reading or baking [s]
  CachedVolumes cached;   ///< without volumes when stopped
};
/// Certifies the config's half-steps of a robot and takes their swept volumes from the cache, or
/// bakes them and puts them there.
BakedHalfSteps BakeHalfSteps(const RobotModel& robot, const ExperimentConfig& config,
                             const PlanningHooks& hooks);
/// The same for a ground: on its levels where it HasLevels.
BakedHalfSteps BakeHalfSteps(const RobotModel& robot, const ExperimentConfig& config,
                             const Ground& ground, const PlanningHooks& hooks);

/// Takes the swept volumes of a set from the cache, or bakes them and puts them there.
CachedVolumes BakeSet(const RobotModel& robot, const ExperimentConfig& config, const StepSet& set,
                      const PlanningHooks& hooks);

/// What stepping in place, where the config's start has the feet, misses, as a clause; "": nothing.
std::string MissedInPlace(const RobotModel& robot, const Scene& scene,
                          const ExperimentConfig& config);

/// Throws InputError: of the config's grid nothing keeps what is demanded, and what stepping in
/// place misses.
[[noreturn]] void ThrowNoHalfStep(const RobotModel& robot, const ExperimentConfig& config);

}  // namespace halfstep
