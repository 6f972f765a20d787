#pragma once

#include <string>
#include <vector>

#include "experiments/experiment.h"
#include "experiments/result_tables.h"

namespace halfstep {

/// Text of manifest.json: what made a run. Commit and library versions of this program, SHA-256 of
/// the resolved config, of the robot's and of the scene's YAML files, seed, host, timings, and the
/// program's objective, and per method what it was asked for, its status and message.
std::string ManifestJson(const Experiment& experiment, const std::string& resolved_config,
                         const std::string& acceptance, const std::vector<MethodRun>& runs,
                         double total_wall);

}  // namespace halfstep
