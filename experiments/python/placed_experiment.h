#pragma once

#include <memory>
#include <string>

#include "experiments/config/experiment.h"
#include "experiments/python/walk_setting.h"

namespace halfstep::python {

/// An experiment as Python holds it: it owns all that it needs.
struct PlacedExperiment {
  /// `file` stands for the text in complaints, and its folder is that of relative paths. `scene`,
  /// unless null, is copied and takes the place of the one that the text names. Throws InputError,
  /// and std::invalid_argument for a plan that steps on a no-step area.
  PlacedExperiment(const std::string& file, const std::string& text, const Scene* scene,
                   const Toolbox& tools);

  /// Throws std::invalid_argument when there is a goal in place of footsteps.
  std::shared_ptr<const WalkSetting> Setting() const;

  std::string path;
  ExperimentConfig config;
  Experiment experiment;
  std::shared_ptr<const WalkSetting> setting;  ///< null with a goal
};

}  // namespace halfstep::python
