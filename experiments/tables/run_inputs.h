#pragma once

#include <cstddef>

#include "experiments/config/experiment_config.h"
#include "experiments/tables/run_folder.h"
#include "planner/scene/scene.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// The most that a run folder takes in of a robot's files, and of a scene's [bytes].
inline constexpr std::size_t kMostInputBytes = std::size_t{16} << 20;

/// Makes a run folder whole by itself: writes copies of the files of robot and scene, as they were
/// parsed, into `inputs/robot` and `inputs/scene`, where they lie to each other as they did, and
/// returns the config with these in place of the originals. Those of a robot, or of a scene, stay
/// where they are, all of them, and so does what the config says, when they are more than `most`
/// [bytes], when one of them is no longer what was parsed, when one is named by an absolute path,
/// or when they have no folder in common but a distant one.
ExperimentConfig WithInputs(const ExperimentConfig& config, const RobotModel& robot,
                            const Scene& scene, RunFolder* folder,
                            std::size_t most = kMostInputBytes);

}  // namespace halfstep
