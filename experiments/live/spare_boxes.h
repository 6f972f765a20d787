#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/config/experiment.h"
#include "experiments/live/live_config.h"
#include "planner/scene/scene.h"

namespace halfstep {

/// The scene with them, behind its own obstacles: 0.2 × 0.2 × 0.1 m, at rest about the
/// origin on the floor, or at z = 0 where there is none.
Scene WithSpareBoxes(Scene scene, const LiveOptions& options);

/// Where an episode takes place: what its config names, and the spare boxes. Throws InputError.
Place LoadEpisodePlace(const LiveConfig& config);

/// An episode ready to begin.
struct LoadedEpisode {
  LiveConfig config;  ///< as its file says it
  Place place;        ///< with the spare boxes
};
/// Reads a config file, changes what it says, and loads what it names. Throws InputError with every
/// complaint, those about what does not fit the scene at their places in the file.
LoadedEpisode LoadEpisode(const std::string& path, const std::vector<YamlOverride>& overrides,
                          const std::function<LiveConfig(LiveConfig)>& change,
                          const Toolbox& tools = {});

}  // namespace halfstep
