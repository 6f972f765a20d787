#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "experiments/config/experiment.h"
#include "experiments/run/crossing.h"

namespace halfstep {

/// Where a config's walk may take place, seen from above in W [m]: its workspace, else `room`
/// around start and goal [m].
Eigen::AlignedBox2d AreaOf(const ExperimentConfig& config, const Place& place, double room = 0.5);

/// Places beside edges of the scene's surfaces in AreaOf, drawn from the config's seed, each with a
/// landing of the config's step set on another level that is at most 0.4 of the leg's length above
/// or below: 96 of them, fewer where 4000 tries find no more. The foot points across the edge, or
/// along it where no sole that points across bears. Soles are borne as the config's `foothold`
/// demands it. Differences of height within about 3 cm are one kind.
std::vector<Crossing> DrawLevelCrossings(const ExperimentConfig& config, const Place& place);

}  // namespace halfstep
