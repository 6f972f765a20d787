#pragma once

#include <string>

#include "experiments/config/experiment.h"
#include "tests/places.h"

namespace halfstep {

/// A shipped experiment, by the name of its config, under the demands of the profile `limit`, where
/// searches have most room.
inline Experiment LoadExperiment(const std::string& name) {
  const std::string folder = InSources("experiments/configs/");
  return Prepare(LoadConfig(folder + name + ".yaml", {{"smoothing.profile", "limit"}}));
}

}  // namespace halfstep
