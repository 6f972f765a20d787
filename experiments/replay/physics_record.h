#pragma once

#include <string>

#include "experiments/replay/episode_physics.h"
#include "experiments/tables/run_folder.h"

namespace halfstep::replay {

/// What `halfstep live --in-physics` prints beside the episode's summary: lines, each with its end.
std::string PhysicsText(const PhysicalOutcome& outcome);

/// The text of a JSON object with `physics` added: all that PhysicsText says.
std::string WithPhysics(const std::string& json, const PhysicalOutcome& outcome);

/// Writes physics.csv into an episode's folder and adds `physics` to its manifest.json, which is
/// there already. Throws InputError when that is no JSON object.
void WritePhysics(const PhysicalOutcome& outcome, const RobotModel& robot, const Scene& scene,
                  RunFolder* folder);

}  // namespace halfstep::replay
