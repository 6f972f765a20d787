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
};

/// Looks for forms that reach from level to level. Places beside edges of the scene's surfaces are
/// drawn from the config's seed, each with a landing on another level; of a small table of forms
/// (duration, via height, crouch, when the waist rises; lengths by the robot's size) those come
/// first of which the best tenth of the places of each difference of height keeps most of what is
/// demanded at a few instants. Nothing of it is proved. Without other levels in reach: the config's
/// form alone. Source: planner/README.md, "By certificates".
HalfStepForms FormsFor(const ExperimentConfig& config, const Place& place);

/// "duration_s: 2.6, via_height_m: 0.17 …": what a form has that differs from another.
std::string Differences(const HalfStepConfig& form, const HalfStepConfig& from);

}  // namespace halfstep
