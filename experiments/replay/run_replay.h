#pragma once

#include "experiments/config/experiment_config.h"
#include "experiments/replay/seeded_replay.h"
#include "experiments/tables/walk_replay.h"

namespace halfstep::replay {

/// What plays the walks of a run with this config; empty where it has no group `replay`. Throws
/// InputError where it has, and this build cannot simulate.
WalkReplayer ReplayerOf(const ExperimentConfig& config);

/// On what the config's robot is played among these obstacles, by these options.
ReplaySetup SetupOf(WholeRobot robot, const SimulatedObstacles& world, const ReplayConfig& options);

}  // namespace halfstep::replay
