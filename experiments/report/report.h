#pragma once

#include <filesystem>
#include <string>

#include "experiments/compare/comparison.h"
#include "experiments/config/experiment.h"
#include "experiments/tables/run_folder.h"
#include "planner/scene/scene.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// report.html of a run whose config may name what `tools` hold, as for all that follows: one page
/// that shows its walks, needs no other file and no network. `folder` holds the run's files; robot
/// and scene are those of the run. The same files give the same bytes. Throws InputError for files
/// that are missing or damaged. Precondition: HasReport().
std::string RunReport(const RobotModel& robot, const Scene& scene,
                      const std::filesystem::path& folder, const Toolbox& tools = {});

/// Writes it as report.html into a folder that has all its other files; does nothing without
/// HasReport(), and of uneven ground, which the page does not draw yet.
void WriteReport(const RobotModel& robot, const Scene& scene, RunFolder* folder,
                 const Toolbox& tools = {});

/// The robot and the scene of a run. Throws InputError when they cannot be read, or when their
/// files are not those that the run's certificate names by their hash.
Place PlaceOfRun(const std::filesystem::path& run, const Toolbox& tools = {});

/// report.html of a comparison: all walks of all its scenarios. A scenario that can no longer be
/// drawn (robot, scene or trajectories are gone or changed) keeps its tables; the page says why.
std::string ComparisonReport(const Comparison& comparison, const Toolbox& tools = {});

}  // namespace halfstep
