#pragma once

#include "experiments/config/experiment.h"
#include "experiments/tables/run_folder.h"

namespace halfstep {

/// Completes the manifest.json that stands in a folder's staging: `robot_sha256`, `scene_sha256`,
/// the `verdict` of each method's certificate, `inputs` (name, length and SHA-256 of each file that
/// robot and scene were parsed from) and `files` (length and SHA-256 of each file that was written
/// to `folder` by this process; what an older manifest says of the others stays). To be called last
/// before Publish(). Throws InputError when the manifest is no JSON object.
void CompleteManifest(const RobotModel& robot, const Scene& scene, RunFolder* folder);

}  // namespace halfstep
