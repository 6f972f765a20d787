#pragma once

#include <functional>
#include <stop_token>
#include <string>

#include "experiments/run/exit_status.h"
#include "experiments/sweep/sweep_folder.h"
#include "experiments/tables/walk_replay.h"

namespace halfstep {

/// What plays the walks of a config; empty where it asks for none.
using ReplayerOf = std::function<WalkReplayer(const ExperimentConfig& config)>;

/// Runs one case of a sweep and writes its folder; a failure makes a row as well. Replaces a folder
/// of the case that is not whole, and keeps one that is. Writes nothing when stopped
/// (kInterrupted). Throws InputError for input that cannot be read, std::runtime_error when files
/// cannot be written.
ExitStatus DoSweepCase(const SweepFolder& folder, const SweepCase& one, std::stop_token stop,
                       const ReplayerOf& replayer_of);

/// Writes the folder of a case whose process died.
void WriteSweepFailure(const SweepFolder& folder, const SweepCase& one, const std::string& status,
                       const std::string& message, double wall);

}  // namespace halfstep
