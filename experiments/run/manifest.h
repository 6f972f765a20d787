#pragma once

#include <string>
#include <vector>

#include "experiments/config/experiment.h"
#include "experiments/tables/result_tables.h"

namespace halfstep {

/// Text of manifest.json: what made a run. Commit and library versions of this program, SHA-256 of
/// the resolved config, seed, host, timings, and the program's objective, and per method what it
/// was asked for, its status, message and work. The hashes of files follow by CompleteManifest.
std::string ManifestJson(const Experiment& experiment, const std::string& resolved_config,
                         const std::string& acceptance, const std::vector<MethodRun>& runs,
                         double total_wall);

}  // namespace halfstep
