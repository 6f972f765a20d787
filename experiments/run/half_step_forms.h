#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/config/experiment.h"
#include "experiments/config/half_step_config.h"

namespace halfstep {

/// Forms of half-steps for the levels of a scene.
struct HalfStepForms {
  /// What to plan with, the most promising first: the config's own where it crosses all that any
  /// other does.
  std::vector<HalfStepConfig> forms;
  /// Differences of height that no form crosses at any place that was tried, a sentence each.
  std::vector<std::string> too_high = {};
  /// Whether other levels are in reach, so that there are other forms than the config's.
  bool on_levels = false;
};

/// Looks for the `wanted` ≥ 1 most promising forms that reach from level to level: of HalfStepTable
/// those come first of which the best tenth of the places of each difference of height
/// (DrawLevelCrossings) keeps most of what is demanded at a few instants. Nothing of it is proved.
/// More forms begin with the same ones. Without other levels in reach: the config's form alone.
/// Source: planner/README.md, "By certificates".
HalfStepForms FormsFor(const ExperimentConfig& config, const Place& place, int wanted);

/// A form that leads over an obstacle that rests, on a flat floor.
struct FormOver {
  std::optional<HalfStepConfig> form = {};  ///< none was found
  std::vector<Foothold> landings = {};  ///< that do so, level, seen from a left support, each once
  std::string missed = {};              ///< what the nearest form misses, where none was found
  double effort = 0.0;                  ///< of looking for it (Work::effort)
};

/// Of TableOverObstacle the most promising form with landings at `places`, seen from a left
/// support: that of which most of the stances astride the obstacle (DrawObstacleCrossings) keep at
/// a few instants what is demanded, with nothing else in the scene, by how much longer its
/// half-steps are, and of which one such stance is certified for all t. Source: planner/README.md,
/// "Over an obstacle".
FormOver FindFormOver(const ExperimentConfig& config, const RobotModel& robot,
                      const Obstacle& obstacle, const std::vector<Foothold>& places);

}  // namespace halfstep
