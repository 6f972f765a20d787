#pragma once

#include <string>

#include "experiments/verify/findings.h"
#include "experiments/verify/verify_run.h"

namespace halfstep::verify {

/// Checks all that an episode's folder says (experiments/episodes.md): files and hashes,
/// config, robot and scene, worlds, walks, grants, and, by its own geometry, that the robot began
/// each half-step only with a way to come to rest. Of what made the episode it includes the reader
/// of its config alone. `manifest_text` is that of manifest.json. Returns what the episode's proofs
/// do not speak of. Throws InputError for what cannot be read.
std::vector<NotCovered> VerifyEpisode(const VerifyOptions& options,
                                      const std::string& manifest_text, Findings* findings);

}  // namespace halfstep::verify
