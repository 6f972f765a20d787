#pragma once

#include <string>
#include <vector>

#include "experiments/config/experiment.h"
#include "experiments/live/live_config.h"
#include "planner/scene/scene.h"

namespace halfstep {

/// Names of the boxes of `live.spare_boxes`: "spare_1", … They are obstacles of an episode that no
/// scene file has, and are not there until something makes them appear.
std::vector<std::string> SpareNames(const LiveOptions& options);

/// The scene with them, behind its own obstacles: 0.2 × 0.2 × 0.1 m, at rest on the floor about the
/// origin. Throws InputError when an obstacle of the scene has such a name.
Scene WithSpareBoxes(Scene scene, const LiveOptions& options);

/// Where an episode takes place: what its config names, and the spare boxes. Throws InputError.
Place LoadEpisodePlace(const LiveConfig& config);

}  // namespace halfstep
