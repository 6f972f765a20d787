#pragma once

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

/// A form that leads over an obstacle.
struct FormOver {
  HalfStepConfig form;
  /// Landings that do so, level, seen from a left support, where the config's step_set has none.
  std::vector<Foothold> landings;
};

/// Forms that lead over an obstacle that rests, on a flat floor.
struct FormsOverObstacle {
  std::vector<FormOver> forms;  ///< the most promising first; empty: none was found
  std::string missed = {};      ///< what the nearest of them misses, where none was found
  double effort = 0.0;          ///< of looking for them (Work::effort)
};

/// Of TableOverObstacle the most promising form with landings at the config's step_set, then that
/// with landings at its PlacesOf: that of which most of the stances astride the obstacle
/// (DrawObstacleCrossings) keep at a few instants what is demanded, with nothing else in the scene,
/// by how much longer its half-steps are, and of which one such stance is certified for all t.
/// Source: planner/README.md, "Over an obstacle".
FormsOverObstacle FormsOver(const ExperimentConfig& config, const RobotModel& robot,
                            const Obstacle& obstacle);

}  // namespace halfstep
