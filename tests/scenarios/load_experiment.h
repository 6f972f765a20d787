#pragma once

#include <string>

#include "experiments/config/experiment.h"

namespace halfstep {

/// A shipped experiment, by the name of its config, under the demands of the profile `limit`, where
/// searches have most room.
inline Experiment LoadExperiment(const std::string& name) {
  const std::string folder = HALFSTEP_SOURCE_DIR "/experiments/configs/";
  return Prepare(LoadConfig(folder + name + ".yaml", {{"smoothing.profile", "limit"}}));
}

}  // namespace halfstep
